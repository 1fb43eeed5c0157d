// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
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

/// The result of processing one scan.
struct SlamResult {
  /// The scan's end points, classified against the map, and the pose. Its covariance is relative to
  /// the current map, which is what matters for comparing things seen at about the same time, plus
  /// the uncertainty that gaps since the first map have left.
  LabeledScan labeled_scan;
  /// How far that map has drifted since the start, about the pose (MapDrift). The sum of both is
  /// the covariance relative to the start.
  Eigen::Matrix3d drift = Eigen::Matrix3d::Zero();
  bool odometry_used = false;      ///< false: predicted with the last estimated velocity
  MatchQuality match;              ///< how well the scan fits the map
  OdometryErrors odometry_errors;  ///< current estimate
  Localization localization = Localization::kLocated;
  int maps_begun = 0;               ///< because the vehicle was not found again in the previous map
  bool searches_prior_map = false;  ///< not located, and searched for in all or part of it
  bool kidnapped = false;           ///< not located, after being carried elsewhere
  bool may_be_kidnapped = false;    ///< located, but this scan may have been taken elsewhere
};

/// What GridSlam needs, besides the cells of its map, to continue in it in another process.
struct SlamState {
  PoseTracker::State pose;  ///< at the last scan
  MapKeeper::State map;
};

/// Maximum-likelihood SLAM on a rolling occupancy grid (thesis 3.1.1, 3.3.1): predicts with the
/// vehicle's own motion, matches the scan to the map, labels the points of the scan as static or
/// moving, and updates the map with the static ones.
///
/// With low-level fusion the measurement is a grid fused from several sensors (thesis 3.2.5) plus
/// the scan of the same stamp: beams end only where the grid is occupied, and the map takes its
/// occupied and free cells. The pose, the moving points and the exact position of surfaces still
/// come from the scanner's own beams, as far as the grid confirms them: the cells of other sensors
/// are coarse and off by their depth error, which would look like motion.
///
/// After a gap in which the vehicle may have gone far, the map is left alone and a new one started,
/// until the vehicle is found in the old one or the search is given up (MapRecovery). The pose's
/// covariance is always relative to the first map's frame: the uncertainty of a gap stays in it
/// until the vehicle is found. While the vehicle is not located, nothing is labeled as moving.
///
/// The same happens after it was carried elsewhere (KidnappingDetector). While that is suspected,
/// nothing is labeled as moving, the map is not updated, and the pose follows odometry alone.
///
/// With a prior map, the vehicle is first searched for in that map, in the same way, and then
/// continues in it. If it gets lost later, all of the prior map is searched, and no new map
/// replaces it, unless it has grown too large to be searched.
///
/// PoseTracker tracks the pose from scan to scan, MapKeeper decides which map is updated and which
/// is searched, SlamMeasurement defines how a fused grid changes a scan; this class combines them.
///
/// Map frame: that of the prior map; without one, its origin is the vehicle's first pose. Not
/// thread-safe; the caller ensures that stamps of scans ascend (StampGate).
class GridSlam {
 public:
  /// Throws OptionError.
  explicit GridSlam(const Checked<GridSlamOptions>& options);

  /// Sets a prior map, before the first scan; reset() returns to this state. Throws
  /// std::invalid_argument for a map with more cells than can be searched.
  void startIn(PriorMap prior_map) { maps_.setPriorMap(std::move(prior_map)); }

  /// Returns the state after the last scan; none while the vehicle is not located, or may not be.
  std::optional<SlamState> state() const;

  /// Continues from the state of an earlier instance with the same options and the same prior map,
  /// before the first scan; `window`: the cells of its map then, or a little before. The time since
  /// then is a gap without scans, and without odometry except for what has been added and its
  /// poses: the vehicle is predicted, and searched for in the old map if it may have gone far. A
  /// moving one is rarely found there, and without it there would be no tracks until the search is
  /// given up: after the time in which odometry can still improve the prediction, it continues in a
  /// new map, in the frame of the old one and with the uncertainty of the gap.
  void continueFrom(const SlamState& state, const std::vector<CellEvidence>& window);

  /// Adds odometry in ascending stamp order, before or after the scans that it is used for. Only a
  /// limited time of it is kept: if scans fail for longer, the pose is predicted with it.
  void addOdometry(const OdometrySample& sample);

  /// Processes the next scan, and labels its points after motion compensation. A scan without rays
  /// only moves the pose, by odometry.
  SlamResult process(const Scan& scan);

  /// Processes the next fused grid, in the vehicle's frame at the scan's stamp. If `scan` has no
  /// rays, the scanner is silent, and pose and moving points come from the grid alone.
  SlamResult process(const SensorGrid& grid, const Scan& scan);

  const OdometryBuffer& odometry() const { return tracker_.odometry(); }

  const OccupancyMap& map() const { return maps_.map(); }

  /// Returns the map to keep: while the vehicle is not located, the one in which it last was.
  const OccupancyMap& lastingMap() const { return maps_.lastingMap(); }

  /// Resets to the state after construction.
  void reset();

 private:
  SlamResult process(const SlamMeasurement& measurement);

  /// Predicts the pose at the next scan's stamp, in the map that it will be matched with. Returns
  /// whether odometry measured most of the motion.
  bool predict(Stamp stamp);
  /// Switches to the map that a prediction has returned to, if it has. Returns the same as
  /// predict().
  bool follow(const PoseTracker::Prediction& prediction);
  /// Starts a new map after a gap.
  void leaveMap(Stamp stamp);
  /// Whether the vehicle, at this pose by prediction, was driving while no process ran.
  bool wasDrivingMeanwhile(const Pose2& predicted) const;
  /// Compares a scan with the map that it was matched with. Returns whether the vehicle may be
  /// elsewhere.
  bool mayBeKidnapped(const Scan& scan, const std::vector<PointState>& states);
  /// Returns to the predicted pose if the scan may have been taken elsewhere.
  void discardMatch(const PoseFilter& predicted, SlamResult& result);
  /// Starts a new map if the vehicle was carried elsewhere.
  void leaveIfKidnapped(Stamp stamp);

  /// The scan as seen at its stamp, by the latest odometry, or else the estimated velocity.
  Scan compensated(const Scan& scan) const;

  PreparedScan prepared(const SlamMeasurement& measurement) const;

  /// Corrects the predicted pose by the scan; returns the prepared scan.
  ///
  /// Without odometry the velocity comes from the matches. A scan compensated for a wrong yaw rate
  /// is matched at a wrong heading, which makes the next yaw rate wrong in the opposite direction;
  /// with a 360-degree field of view such errors never decay. So the scan is compensated again for
  /// the motion given by its own match.
  PreparedScan locate(const SlamMeasurement& measurement, SlamResult& result);

  /// Labels the scan by the map, and then adds it, or the `grid`, if not null, to the map.
  void write(const PreparedScan& scan, const SensorGrid* grid,
             const PoseWithCovariance& base_in_map, SlamResult& result);

  /// Updates the drift for the current pose, from which the scan was added to the map, if it was.
  void followDrift(const Scan& scan, SlamResult& result);

  /// One step of the search in the map that was left, if any.
  void search(Stamp stamp);

  GridSlamOptions options_;
  ScanMatcher matcher_;
  Random random_;
  PoseTracker tracker_;
  MapKeeper maps_;
  KidnappingDetector kidnapping_;
  std::optional<Pose2> continued_from_;  ///< by continueFrom(), until the vehicle is located
};

}  // namespace datmo
