#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/random.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/odometry_buffer.h"
#include "datmo_fusion/slam/pose_filter.h"
#include "datmo_fusion/slam/scan_matcher.h"

namespace datmo {

struct GridSlamOptions {
  OccupancyMapOptions map;
  MotionModelOptions motion;
  PoseFilterOptions pose;
  ScanMatcherOptions matcher;
  double odometry_hold = 0.5;  ///< s
  bool motion_compensation = true;
  double longest_step = 5.0;  ///< m
  int seed = 1;

  void visit(OptionVisitor& visitor);
};

/// What one scan led to.
struct SlamResult {
  SplitScan split;                 ///< the scan's end points, judged against the map, and the pose
  bool odometry_used = false;      ///< false: predicted with the last estimated velocity
  MatchQuality match;              ///< how well the scan fits the map
  OdometryErrors odometry_errors;  ///< as estimated so far
};

/// Maximum-likelihood SLAM on a rolling occupancy grid (thesis 3.1.1, 3.3.1): predict with the
/// vehicle's own motion, match the scan to the map, split the scan into static and moving points,
/// and update the map with what stands still.
///
/// Map frame: the vehicle's first pose is its origin. Not thread safe; scans in rising stamp order,
/// which the caller ensures (StampGate).
class GridSlam {
 public:
  /// Throws OptionError.
  explicit GridSlam(const GridSlamOptions& options);

  /// Odometry in rising stamp order; it may come before or after the scans that it serves. Only a
  /// bounded time of it is kept.
  void addOdometry(const OdometrySample& sample) { odometry_.add(sample); }

  /// Takes the next scan, and splits it as compensated for the vehicle's motion. A scan without
  /// rays moves the pose by odometry alone.
  SlamResult process(const Scan& scan);

  const OccupancyMap& map() const { return map_; }

  /// Forgets everything, as after construction.
  void reset();

 private:
  /// The scan as seen at its stamp, by the newest odometry or else the estimated velocity.
  Scan compensated(const Scan& scan) const;
  /// Corrects the predicted pose by the scan; returns the scan as compensated for its motion.
  ///
  /// Without odometry the velocity comes from the matches. A scan that was compensated for a wrong
  /// turn is matched at a wrong heading, which makes the next turn wrong the other way: of beams
  /// that go all round, such errors never fade. So the scan is compensated again for the motion
  /// that its own match tells.
  Scan locate(const Scan& measured, SlamResult& result);

  /// Returns whether odometry served.
  bool predict(Stamp stamp);

  GridSlamOptions options_;
  ScanMatcher matcher_;
  OccupancyMap map_;
  OdometryBuffer odometry_;
  Random random_;
  PoseFilter filter_;
  std::optional<Stamp> stamp_;  ///< of the last scan
};

}  // namespace datmo
