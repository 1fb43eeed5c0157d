// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Geometry>

#include <ros/time.h>
#include <tf2/buffer_core.h>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Maximum distance of a sensor from the vehicle's origin, m.
constexpr double kMaxMountDistance = 100.0;

/// Mounting of a planar scanner on the vehicle.
struct ScannerMount {
  Pose2 scanner_in_base;     ///< the scanner's position and x axis in the plane
  bool upside_down = false;  ///< its bearings increase clockwise
  double tilt = 0.0;         ///< rad, 0 to pi/2, between the scan plane and the ground
};

/// Returns the newest mount in tf. Throws InputError: `missing_transform` if there is none,
/// `mount_too_far` if it is farther than kMaxMountDistance.
ScannerMount scannerMount(const tf2::BufferCore& transforms, const std::string& base_frame,
                          const std::string& scanner_frame);

/// Returns the newest pose of a sensor's frame in tf. Throws InputError (`missing_transform`) if
/// there is none.
Eigen::Isometry3d sensorMount(const tf2::BufferCore& transforms, const std::string& base_frame,
                              const std::string& sensor_frame);

/// Returns the planar pose of a frame in another one at a stamp. Throws InputError
/// (`missing_transform`) if tf does not have it.
Pose2 planarPose(const tf2::BufferCore& transforms, const std::string& parent_frame,
                 const std::string& child_frame, const ros::Time& time);

}  // namespace datmo
