// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <datmo_fusion/RadarScan.h>

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/convert/messages.h"

namespace datmo {

/// Describe a message in a few words for people. Nothing is checked: missing fields are omitted,
/// bad values are shown unchanged.
///
/// "360 beams to 8.0 m in frame laser, 12.5 Hz"; the rate is the one in the scan.
std::string descriptionOf(const sensor_msgs::LaserScan& scan);
std::string descriptionOf(const sensor_msgs::MultiEchoLaserScan& scan);

/// "in odom -> base_link"
std::string descriptionOf(const nav_msgs::Odometry& odometry);

/// "640 x 480 points in frame camera"
std::string descriptionOf(const sensor_msgs::PointCloud2& cloud);

/// "64 returns in frame radar"
std::string descriptionOf(const datmo_fusion::RadarScan& scan);

/// "id 3, pedestrian, at (4.1, -0.3) m in map"
std::string descriptionOf(const TrackMessage& track, const std::string& frame);

}  // namespace datmo
