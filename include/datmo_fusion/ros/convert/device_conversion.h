// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <geometry_msgs/TwistStamped.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/device/device_data.h"

namespace datmo {

sensor_msgs::LaserScanPtr toMessage(const DeviceScan& scan, Stamp stamp, const std::string& frame);

/// Fields x, y, z, intensity, ring (UINT16) and time (FLOAT32, s after the stamp), named as in
/// velodyne_pointcloud.
sensor_msgs::PointCloud2Ptr toMessage(const DeviceCloud& cloud, Stamp stamp,
                                      const std::string& frame);

/// Without a position the status is STATUS_NO_FIX.
sensor_msgs::NavSatFixPtr toMessage(const SatelliteFix& fix, Stamp stamp, const std::string& frame);

/// Converts the speed to the vehicle's own forward speed: an antenna does not tell the vehicle's
/// heading. So the frame is empty, meaning the vehicle's.
geometry_msgs::TwistStampedPtr toMessage(const GroundVelocity& velocity, Stamp stamp,
                                         const std::string& frame);

/// The frame is empty, meaning the vehicle's.
geometry_msgs::TwistStampedPtr toMessage(const VehicleTwist& twist, Stamp stamp,
                                         const std::string& frame);

}  // namespace datmo
