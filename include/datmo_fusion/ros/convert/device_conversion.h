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

/// Fields x, y, z, intensity, ring (UINT16) and time (FLOAT32, s after the stamp), as
/// velodyne_pointcloud names them.
sensor_msgs::PointCloud2Ptr toMessage(const DeviceCloud& cloud, Stamp stamp,
                                      const std::string& frame);

/// Without a position the status says so.
sensor_msgs::NavSatFixPtr toMessage(const SatelliteFix& fix, Stamp stamp, const std::string& frame);

/// The speed as the vehicle's own, ahead: an antenna does not tell where the vehicle looks. So the
/// frame is empty, the vehicle's.
geometry_msgs::TwistStampedPtr toMessage(const GroundVelocity& velocity, Stamp stamp,
                                         const std::string& frame);

/// The frame is empty, the vehicle's.
geometry_msgs::TwistStampedPtr toMessage(const VehicleTwist& twist, Stamp stamp,
                                         const std::string& frame);

}  // namespace datmo
