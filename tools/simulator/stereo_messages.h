// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simulator/stereo_camera.h"

#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/common/stamp.h"

namespace datmo::simulator {

/// The mount of the left camera as published, including its error: base_link -> stereo_left_optical
/// (x right, y down, z forward).
geometry_msgs::TransformStamped toMount(const StereoCameraOptions& options, Stamp stamp);

/// Points as published by stereo_image_proc, but without colors and holes: a list of x, y, z
/// (float32, m) of the points found.
sensor_msgs::PointCloud2 toCloud(const StereoPoints& points, Stamp stamp);

/// Of rectified images; the right camera's projection has the baseline (P[3] = -f B).
sensor_msgs::CameraInfo toLeftInfo(const StereoCameraOptions& options, Stamp stamp);
sensor_msgs::CameraInfo toRightInfo(const StereoCameraOptions& options, Stamp stamp);

}  // namespace datmo::simulator
