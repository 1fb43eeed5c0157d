// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/vision/point_velocity.h"

namespace datmo {

/// Converts points with velocity to a cloud of one row: x, y, z (m), vx, vy, vz (m/s over ground,
/// the frame's axes), the independent covariance of vx and vy (xx, xy, yy, m^2/s^2) and the one
/// shared with other points (common_xx, common_xy, common_yy), all FLOAT32.
sensor_msgs::PointCloud2Ptr toMessage(const std::vector<PointVelocity>& points, Stamp stamp,
                                      const std::string& frame);

/// The inverse; the variance of the z velocity is the sum of those of x and y. Non-finite points
/// and those with an invalid covariance are dropped. Throws InputError (`missing_field`,
/// `wrong_field_type`, `big_endian`, `wrong_size`).
std::vector<PointVelocity> pointVelocities(const sensor_msgs::PointCloud2& message);

}  // namespace datmo
