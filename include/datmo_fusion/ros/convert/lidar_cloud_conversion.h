// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/sensor_model/lidar_points.h"

namespace datmo {

/// A cloud of a 3D lidar as its message has it.
struct ConvertedCloud {
  LidarCloud cloud;        ///< its finite points; the mount is not set
  std::size_t holes = 0;   ///< points that are not finite: left out
  std::string time_field;  ///< that the points' times are from; empty: there is none
  std::optional<InputError> unusable_times;  ///< `bad_point_times`: why they are left out
};

/// Points that are not finite are left out. The time of each point is read from the first of the
/// fields `t`, `offset_time` (UINT32, ns after the stamp: Ouster, Livox), `time` (FLOAT32 or
/// FLOAT64, s after the stamp: Velodyne) and `timestamp` (FLOAT64, s after the stamp or, as Hesai
/// and RoboSense have it, since 1970) that there is. Times more than `max_sweep` (s) off the stamp
/// do not cost the cloud.
///
/// Throws InputError as CloudPoints does: `empty_cloud`, `missing_field`, `wrong_field_type`,
/// `big_endian`, `wrong_size`, `no_valid_point`.
ConvertedCloud toLidarCloud(const sensor_msgs::PointCloud2& message, double max_sweep);

/// The option of that name.
void visitMaxSweep(OptionVisitor& visitor, double& max_sweep);

}  // namespace datmo
