// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/range_bearing.h"

#include "datmo_fusion/common/perpendicular.h"

namespace datmo {

namespace {

/// m; closer to the sensor than this, a bearing carries no directional information.
constexpr double kMinRange = 0.1;

}  // namespace

Eigen::Matrix2d rangeBearingCovariance(const Point2& from_sensor, double range_variance,
                                       double bearing_variance) {
  const double range = from_sensor.norm();
  if (range < kMinRange) {
    return range_variance * Eigen::Matrix2d::Identity();
  }
  const Point2 along = from_sensor / range;
  const Point2 across = perpendicular(along);
  return range_variance * along * along.transpose() +
         range * range * bearing_variance * across * across.transpose();
}

}  // namespace datmo
