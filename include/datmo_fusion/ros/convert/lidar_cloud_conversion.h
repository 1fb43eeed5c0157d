// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/sensor_model/lidar_points.h"

namespace datmo {

/// A converted cloud of a 3D lidar.
struct ConvertedCloud {
  LidarCloud cloud;        ///< the finite points; the mount is not set
  std::size_t holes = 0;   ///< number of dropped non-finite points
  std::string time_field;  ///< field that the points' times come from; empty: none
  std::optional<InputError> unusable_times;  ///< `bad_point_times`: why the times are ignored
};

/// Converts a cloud; non-finite points are dropped. The time of each point is read from the first
/// of these fields that is present: `t`, `offset_time` (UINT32, ns after the stamp: Ouster, Livox),
/// `time` (FLOAT32 or FLOAT64, s after the stamp: Velodyne) and `timestamp` (FLOAT64, s after the
/// stamp or, for Hesai and RoboSense, since 1970). Times more than `max_sweep` (s) from the stamp
/// are ignored; the cloud is still used.
///
/// Throws InputError like CloudPoints: `empty_cloud`, `missing_field`, `wrong_field_type`,
/// `big_endian`, `wrong_size`, `no_valid_point`.
ConvertedCloud toLidarCloud(const sensor_msgs::PointCloud2& message, double max_sweep);

/// Visits the option `max_sweep`.
void visitMaxSweep(OptionVisitor& visitor, double& max_sweep);

}  // namespace datmo
