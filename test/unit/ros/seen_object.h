// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/common/object.h"

namespace datmo::samples {

/// An object that a sensor saw well and from all sides.
inline Object seenObject(const std::string& sensor, const Box2& box) {
  Object object;
  object.box = box;
  object.position_covariance = 0.04 * Eigen::Matrix2d::Identity();
  object.heading_variance = 0.01;
  object.side_variance.fill(0.01);
  object.sensors = {sensor};
  return object;
}

}  // namespace datmo::samples
