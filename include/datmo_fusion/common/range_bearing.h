// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Returns the covariance of a position measured by range and bearing (thesis 3.3.3), in the frame
/// of `from_sensor`.
///
/// @param from_sensor m, from the sensor to the position
/// @param range_variance m^2
/// @param bearing_variance rad^2
Eigen::Matrix2d rangeBearingCovariance(const Point2& from_sensor, double range_variance,
                                       double bearing_variance);

}  // namespace datmo
