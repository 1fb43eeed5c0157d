// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/vision/point_velocity.h"

namespace datmo {

/// Points with velocity as a cloud of one row: x, y, z (m), vx, vy, vz (m/s over the ground, the
/// frame's axes), what is not known of vx and vy by itself (xx, xy, yy, m^2/s^2) and in common with
/// other points (common_xx, common_xy, common_yy), all FLOAT32.
sensor_msgs::PointCloud2Ptr toMessage(const std::vector<PointVelocity>& points, Stamp stamp,
                                      const std::string& frame);

/// The same back, z of the velocity with the variance of what is not known of x and y together.
/// Points that are not finite, or whose covariance is none, are left out. Throws InputError
/// (`missing_field`, `wrong_field_type`, `big_endian`, `wrong_size`).
std::vector<PointVelocity> pointVelocities(const sensor_msgs::PointCloud2& message);

}  // namespace datmo
