// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/random.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/slam/grid_masked_scan.h"
#include "datmo_fusion/slam/kidnapping_detector.h"
#include "datmo_fusion/slam/map_keeper.h"
#include "datmo_fusion/slam/pose_tracker.h"
#include "datmo_fusion/slam/scan_matcher.h"
#include "datmo_fusion/slam/slam_measurement.h"

namespace datmo {

struct GridSlamOptions {
  OccupancyMapOptions map;
  MotionModelOptions motion;
  PoseFilterOptions pose;
  ScanMatcherOptions matcher;
  MapRecoveryOptions recovery;
  double odometry_hold = 0.5;  ///< s
  bool motion_compensation = true;
  double max_step = 5.0;  ///< m
  GridEnds grid_ends = GridEnds::kScan;
  int seed = 1;

  void visit(OptionVisitor& visitor);
};

/// What one scan led to.
struct SlamResult {
  /// The scan's end points, judged against the map, and the pose. Its covariance is that in the map
  /// as it is now, in which things seen at about the same time are compared, and of what gaps left
  /// open since the first map.
  LabeledScan labeled_scan;
  /// How far that map has drifted since the start, about the pose (MapDrift): with this in addition
  /// the covariance is that since the start.
  Eigen::Matrix3d drift = Eigen::Matrix3d::Zero();
  bool odometry_used = false;      ///< false: predicted with the last estimated velocity
  MatchQuality match;              ///< how well the scan fits the map
  OdometryErrors odometry_errors;  ///< as estimated so far
  Localization localization = Localization::kLocated;
  int maps_begun = 0;               ///< since the vehicle was not found again in the map before
  bool searches_prior_map = false;  ///< not located, and looked for in all or a part of that
  bool kidnapped = false;           ///< not located, since it was carried elsewhere
  bool may_be_kidnapped = false;    ///< located, but this scan may have been made elsewhere
};

/// Maximum-likelihood SLAM on a rolling occupancy grid (thesis 3.1.1, 3.3.1): predict with the
/// vehicle's own motion, match the scan to the map, label the points of the scan as static or
/// moving, and update the map with what stands still.
///
/// With low-level fusion the measurement is a grid fused from several sensors (thesis 3.2.5) beside
/// the scan of the same stamp: beams end only where the grid is occupied, and the map takes its
/// occupied and free cells. Where the pose comes from, what moves and where exactly a surface lies
/// is still decided by the scanner's own beams as far as the grid confirms them: the cells of
/// others are coarse, and off by their depth's error, which would look like motion.
///
/// After a gap in which the vehicle may have gone far the map is left alone and a new one begun,
/// until the vehicle is found in the old one or it is given up (MapRecovery). The pose's covariance
/// is always that in the first map's frame: what a gap left open stays in it until it is found.
/// While the vehicle is not located, nothing is said to move.
///
/// The same after it was carried elsewhere (KidnappingDetector); of a scan that may have been made
/// there nothing is said to move, nothing is written, and the pose follows the odometry alone.
///
/// With a prior map the vehicle is searched for in it first, in the same way; it then goes on in
/// that map. If it gets lost later, all of the prior map is searched, and no new map takes its
/// place.
///
/// What each part does: PoseTracker follows the pose from scan to scan, MapKeeper knows which map
/// is written to and which is searched, SlamMeasurement what a fused grid changes of a scan; this
/// class puts them together.
///
/// Map frame: the prior map's; without one the vehicle's first pose is its origin. Not thread safe;
/// scans in rising stamp order, which the caller ensures (StampGate).
class GridSlam {
 public:
  /// Throws OptionError.
  explicit GridSlam(const Checked<GridSlamOptions>& options);

  /// To be called before the first scan; reset() goes back to here. Throws std::invalid_argument
  /// for a map that reaches over more cells than can be searched.
  void startIn(PriorMap prior_map) { maps_.setPriorMap(std::move(prior_map)); }

  /// Odometry in rising stamp order; it may come before or after the scans that it serves. Only a
  /// bounded time of it is kept: while scans fail for longer, the pose goes on with it.
  void addOdometry(const OdometrySample& sample);

  /// Takes the next scan, and labels it as compensated for the vehicle's motion. A scan without
  /// rays moves the pose by odometry alone.
  SlamResult process(const Scan& scan);

  /// Takes the next fused grid, in the vehicle's frame at the scan's stamp. `scan` without rays:
  /// the scanner is silent, and pose and movers come from the grid alone.
  SlamResult process(const SensorGrid& grid, const Scan& scan);

  const OdometryBuffer& odometry() const { return tracker_.odometry(); }

  const OccupancyMap& map() const { return maps_.map(); }

  /// The map to keep: while the vehicle is not located, the one in which it was.
  const OccupancyMap& lastingMap() const { return maps_.lastingMap(); }

  /// Forgets everything, as after construction.
  void reset();

 private:
  SlamResult process(const SlamMeasurement& measurement);

  /// To the stamp of the next scan, into the map that it will be matched with. Returns whether
  /// odometry measured most of the motion.
  bool predict(Stamp stamp);
  /// To the map that a prediction has led back to, if it has. Returns the same.
  bool follow(const PoseTracker::Prediction& prediction);
  /// After a gap: begins a new map.
  void leaveMap(Stamp stamp);
  /// Compares a scan with the map that it was matched with. Returns whether the vehicle may be
  /// elsewhere.
  bool mayBeKidnapped(const Scan& scan, const std::vector<PointState>& states);
  /// Back to the pose that was predicted for a scan that may have been made elsewhere.
  void discardMatch(const PoseFilter& predicted, SlamResult& result);
  /// Begins a new map, if the vehicle was carried elsewhere.
  void leaveIfKidnapped(Stamp stamp);

  /// The scan as seen at its stamp, by the newest odometry or else the estimated velocity.
  Scan compensated(const Scan& scan) const;

  /// Corrects the predicted pose by the scan; returns the scan as compensated for its motion.
  ///
  /// Without odometry the velocity comes from the matches. A scan that was compensated for a wrong
  /// turn is matched at a wrong heading, which makes the next turn wrong in the other direction: of
  /// beams that go all round, such errors never fade. So the scan is compensated again for the
  /// motion that its own match gives.
  Scan locate(const SlamMeasurement& measurement, SlamResult& result);

  /// To where the vehicle is now; the scan is about to be written to the map from there.
  void followDrift(const PoseWithCovariance& base_in_map, const Scan& scan, SlamResult& result);

  /// Labels the compensated scan by the map, and then writes it to the map.
  void write(const SlamMeasurement& measurement, const Scan& scan,
             const PoseWithCovariance& base_in_map, SlamResult& result);

  /// One step back into the map that was left, if one was.
  void search(Stamp stamp);

  GridSlamOptions options_;
  ScanMatcher matcher_;
  Random random_;
  PoseTracker tracker_;
  MapKeeper maps_;
  KidnappingDetector kidnapping_;
};

}  // namespace datmo
