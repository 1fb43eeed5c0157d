#pragma once

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// The road around the vehicle as a plane in its frame: z = height + slope_x x + slope_y y, m.
struct RoadPlane {
  double height = 0.0;   ///< m, at the frame's origin
  double slope_x = 0.0;  ///< m / m
  double slope_y = 0.0;

  /// m above the road; negative below it. `point`: base frame, m.
  double heightOf(const Eigen::Vector3d& point) const {
    return point.z() - (height + slope_x * point.x() + slope_y * point.y());
  }
};

}  // namespace datmo
