// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/random.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/grid_masked_scan.h"
#include "datmo_fusion/slam/map_drift.h"
#include "datmo_fusion/slam/map_recovery.h"
#include "datmo_fusion/slam/odometry_anchor.h"
#include "datmo_fusion/slam/odometry_buffer.h"
#include "datmo_fusion/slam/pose_filter.h"
#include "datmo_fusion/slam/scan_matcher.h"

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
};

/// A map that was made before, and where in it the vehicle may be when the first scan comes.
struct PriorMap {
  OccupancyMap map;
  SearchRegion start;
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
/// With a prior map the vehicle is searched for in it first, in the same way; it then goes on in
/// that map. If it gets lost later, all of the prior map is searched, and no new map takes its
/// place.
///
/// Map frame: the prior map's; without one the vehicle's first pose is its origin. Not thread safe;
/// scans in rising stamp order, which the caller ensures (StampGate).
class GridSlam {
 public:
  /// Throws OptionError.
  explicit GridSlam(const Checked<GridSlamOptions>& options);

  /// To be called before the first scan; reset() goes back to here. Throws std::invalid_argument
  /// for a map that reaches over more cells than can be searched.
  void startIn(PriorMap prior_map);

  /// Odometry in rising stamp order; it may come before or after the scans that it serves. Only a
  /// bounded time of it is kept: while scans fail for longer, the pose goes on with it.
  void addOdometry(const OdometrySample& sample);

  /// Takes the next scan, and labels it as compensated for the vehicle's motion. A scan without
  /// rays moves the pose by odometry alone.
  SlamResult process(const Scan& scan);

  /// Takes the next fused grid, in the vehicle's frame at the scan's stamp. `scan` without rays:
  /// the scanner is silent, and pose and movers come from the grid alone.
  SlamResult process(const SensorGrid& grid, const Scan& scan);

  const OdometryBuffer& odometry() const { return odometry_; }

  const OccupancyMap& map() const { return map_; }

  /// The map to keep: while the vehicle is not located, the one in which it was.
  const OccupancyMap& lastingMap() const { return recovery_ ? recovery_->older() : map_; }

  /// Forgets everything, as after construction.
  void reset();

 private:
  /// The scan as seen at its stamp, by the newest odometry or else the estimated velocity.
  Scan compensated(const Scan& scan) const;
  /// A scan, and the fused grid of its time where there is one.
  struct Measurement {
    const Scan& scan;
    const SensorGrid* grid = nullptr;
  };

  /// The scan of a measurement as the grid, if there is one, lets it stand.
  GridMaskedScan viewOf(const Measurement& measurement, const Scan& compensated_scan) const;

  SlamResult process(const Measurement& measurement);

  /// Corrects the predicted pose by the scan; returns the scan as compensated for its motion.
  ///
  /// Without odometry the velocity comes from the matches. A scan that was compensated for a wrong
  /// turn is matched at a wrong heading, which makes the next turn wrong in the other direction: of
  /// beams that go all round, such errors never fade. So the scan is compensated again for the
  /// motion that its own match gives.
  Scan locate(const Measurement& measurement, SlamResult& result);

  /// Leaves the map alone and begins a new one, by which the vehicle is searched for in a prior
  /// map.
  void searchPriorMap(OccupancyMap whole, const SearchRegion& region, Stamp stamp);

  /// If the last scan is long ago, and the pose much less certain than then: begins a new map.
  void leaveMapAfterGap(Stamp stamp);
  bool isGap(double seconds) const;
  /// Where odometry comes only after the first scan behind a gap: back to before the gap.
  void undoGapForOdometry(Stamp stamp);
  /// One step back into the map that was left; what it changes holds from the next scan on.
  void recover(Stamp stamp);
  void returnToMap();
  MapDrift noDrift() const;
  /// To where the vehicle is now; the scan is about to be written to the map from there.
  void followDrift(const PoseWithCovariance& base_in_map, const Scan& scan, SlamResult& result);
  /// Of the pose, with all that gaps left open of the map's own frame.
  PoseWithCovariance poseInFirstMap() const;
  void rememberScan(const Scan& scan);

  /// m/s; for odometry that measures none.
  double estimatedSpeed() const { return filter_.velocity().forward_speed; }

  /// From the last stamp to a later one. Returns whether odometry measured most of the motion.
  bool predict(Stamp stamp);
  /// The same where odometry is overdue since `seconds` before `stamp`, or the last one: measured
  /// as far as it goes, and on from there by the velocity, of which late odometry tells what it
  /// was.
  void extrapolate(Stamp stamp, double seconds);

  GridSlamOptions options_;
  ScanMatcher matcher_;
  OccupancyMap map_;
  OdometryBuffer odometry_;
  OdometryAnchor anchor_;
  Random random_;
  PoseFilter filter_;
  Stamp late_odometry_;         ///< of the newest sample, when it was last overdue
  std::optional<Stamp> stamp_;  ///< of the pose: the last scan, or odometry since

  /// The last scan that saw anything, and the pose then.
  struct LastScan {
    Stamp stamp;
    PoseFilter filter;
    double interval = 0.0;  ///< s, mean of those before
  };
  std::optional<LastScan> last_scan_;
  std::optional<LastScan> before_gap_;  ///< while odometry may still come for it
  Stamp gap_end_;                       ///< of the first scan behind that gap
  std::optional<MapRecovery> recovery_;
  MapDrift drift_;
  MapDrift drift_of_left_map_;                 ///< while recovery_ searches it
  std::shared_ptr<const PriorMap> prior_map_;  ///< its window holds all that is known
  /// Of the map's frame in that of the first map, about the origin.
  Eigen::Matrix3d frame_covariance_ = Eigen::Matrix3d::Zero();
  int maps_begun_ = 0;
};

}  // namespace datmo
