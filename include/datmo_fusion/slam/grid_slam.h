#pragma once

#include <memory>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/motion_model.h"
#include "datmo_fusion/slam/scan_matcher.h"

namespace datmo_fusion {

struct GridSlamOptions {
  OccupancyMapOptions map;
  MotionModelOptions motion;
  ScanMatcherOptions matcher;
  int seed = 1;  ///< of the motion model's samples

  void visit(OptionVisitor& visitor);
};

/// Speed and turn rate as the vehicle measured them at one time.
struct OdometrySample {
  Stamp stamp;
  Twist2 twist;
};

/// What one scan led to.
struct SlamResult {
  SplitScan split;              ///< the scan's end points, judged against the map, and the pose
  bool odometry_used = false;   ///< false: predicted with the last estimated velocity
  MatchQuality match;           ///< how well the scan fits the map
};

/// Maximum-likelihood SLAM on a rolling occupancy grid (thesis 3.1.1, 3.3.1): predict with the
/// vehicle's own motion, match the scan to the map, split the scan into static and moving points, and
/// update the map with what stands still.
///
/// Map frame: the vehicle's first pose is its origin. Not thread safe; scans in rising stamp order,
/// which the caller ensures (StampGate).
class GridSlam {
 public:
  /// Throws OptionError.
  explicit GridSlam(const GridSlamOptions& options);
  ~GridSlam();

  /// Odometry in rising stamp order; it may come before or after the scans that it serves. Only a
  /// bounded time of it is kept.
  void addOdometry(const OdometrySample& sample);

  /// Takes the next scan. A scan without rays moves the pose by odometry alone.
  SlamResult process(const Scan& scan);

  const OccupancyMap& map() const;

  /// Forgets everything, as after construction.
  void reset();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace datmo_fusion
