// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "datmo_fusion/common/object.h"

namespace datmo {

constexpr std::size_t sideIndex(BoxSide side) { return static_cast<std::size_t>(side); }

/// A valid object without size, of which nothing but its position is known; `sigma` in m, along
/// each axis.
inline Object pointObject(double x, double y, double sigma, const std::string& sensor = "lidar") {
  Object object;
  object.box.center = Pose2(x, y, 0.0);
  object.position_covariance = Eigen::Matrix2d::Identity() * sigma * sigma;
  object.sensors = {sensor};
  return object;
}

/// A box along x of which all sides are seen with this variance (m^2).
inline Object boxObject(double x, double y, double length, double width, double side_variance,
                        const std::string& sensor = "lidar") {
  Object object = pointObject(x, y, 0.1, sensor);
  object.box.length = length;
  object.box.width = width;
  object.heading_variance = 0.001;
  object.side_variance.fill(side_variance);
  return object;
}

inline void hide(Object& object, BoxSide side) {
  object.side_variance[sideIndex(side)] = kHiddenSide;
}

}  // namespace datmo
