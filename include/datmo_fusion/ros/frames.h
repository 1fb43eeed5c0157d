// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Geometry>

#include <ros/time.h>
#include <tf2/buffer_core.h>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// No sensor of a vehicle is farther from its origin, m.
constexpr double kMaxMountDistance = 100.0;

/// How a planar scanner is mounted on the vehicle.
struct ScannerMount {
  Pose2 scanner_in_base;     ///< the scanner's position and x axis, seen from above
  bool upside_down = false;  ///< its bearings count to the right
  double tilt = 0.0;         ///< rad, 0 to pi/2, between the scan plane and the ground
};

/// The newest mount that tf knows. Throws InputError: `missing_transform` if it knows none,
/// `mount_too_far` if it is farther than kMaxMountDistance.
ScannerMount scannerMount(const tf2::BufferCore& transforms, const std::string& base_frame,
                          const std::string& scanner_frame);

/// The newest pose of a sensor's frame that tf knows. Throws InputError (`missing_transform`) if it
/// knows none.
Eigen::Isometry3d sensorMount(const tf2::BufferCore& transforms, const std::string& base_frame,
                              const std::string& sensor_frame);

/// Pose of a frame in another one at a time, seen from above. Throws InputError
/// (`missing_transform`) if tf does not know it.
Pose2 planarPose(const tf2::BufferCore& transforms, const std::string& parent_frame,
                 const std::string& child_frame, const ros::Time& time);

}  // namespace datmo
