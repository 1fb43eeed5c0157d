// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// The road around the vehicle, as a plane in its frame: z = height + slope_x x + slope_y y, m.
struct RoadPlane {
  double height = 0.0;   ///< m, at the frame's origin
  double slope_x = 0.0;  ///< m / m
  double slope_y = 0.0;

  /// Returns the height above the road, m; negative below it. `point`: base frame, m.
  double heightOf(const Eigen::Vector3d& point) const {
    return point.z() - (height + slope_x * point.x() + slope_y * point.y());
  }
};

struct RoadPlaneOptions {
  bool estimate = true;
  double max_distance = 30.0;  ///< m
  double half_width = 8.0;     ///< m
  double tolerance = 0.1;      ///< m
  int min_cells = 30;          ///< cells of 1 m x 1 m
  double max_slope = 0.1;      ///< m / m
  double max_height = 0.4;     ///< m

  void visit(OptionVisitor& visitor);
};

/// Finds the road plane in the points of a stereo camera, so that the layer of obstacles follows
/// slopes and pitching; the thesis assumes a flat road (3.2.2).
///
/// Trimmed least squares starting from the last plane, with one vote per square meter of road,
/// first near the vehicle, then farther out. There is no random sampling, so the same clouds give
/// the same planes. Keeps the last plane from cloud to cloud.
class RoadPlaneEstimator {
 public:
  /// Throws OptionError.
  explicit RoadPlaneEstimator(const Checked<RoadPlaneOptions>& options);

  /// Returns the plane of the cloud's road; none if it is not credible, or `estimate` is off.
  std::optional<RoadPlane> update(const StereoCloud& cloud);

  /// Returns the last credible plane; at first the flat road z = 0.
  const RoadPlane& last() const { return last_; }

  /// Resets to the state after construction.
  void reset() { last_ = {}; }

 private:
  RoadPlaneOptions options_;
  RoadPlane last_;
};

}  // namespace datmo
