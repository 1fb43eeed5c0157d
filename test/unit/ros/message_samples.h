// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/stage/input_error.h"

/// Small valid messages, which tests modify.
namespace datmo::samples {

inline constexpr double kStart = 100.0;  // s

/// Three beams: to the right, ahead, to the left; 1 to 20 m.
inline sensor_msgs::LaserScan laserScan(const std::vector<float>& ranges = {2.0F, 3.0F, 4.0F}) {
  sensor_msgs::LaserScan scan;
  scan.header.frame_id = "scanner";
  scan.header.stamp = ros::Time(kStart);
  scan.angle_min = static_cast<float>(-M_PI_2);
  scan.angle_max = static_cast<float>(M_PI_2);
  scan.angle_increment = static_cast<float>(M_PI_2);
  scan.range_min = 1.0F;
  scan.range_max = 20.0F;
  scan.ranges = ranges;
  return scan;
}

/// 81 beams without returns, in 160 degrees ahead.
inline sensor_msgs::LaserScan scanWithoutReturns(double seconds) {
  constexpr std::size_t kBeams = 81;
  sensor_msgs::LaserScan scan =
      laserScan(std::vector<float>(kBeams, std::numeric_limits<float>::infinity()));
  scan.header.stamp = ros::Time(seconds);
  scan.angle_min = -static_cast<float>(degrees(80.0));
  scan.angle_max = static_cast<float>(degrees(80.0));
  scan.angle_increment = static_cast<float>(degrees(2.0));
  scan.range_max = 50.0F;
  return scan;
}

/// From parent to child, along x, turned by roll, pitch or yaw alone.
inline geometry_msgs::TransformStamped transform(const std::string& parent,
                                                 const std::string& child, double x,
                                                 double seconds = kStart) {
  geometry_msgs::TransformStamped result;
  result.header.frame_id = parent;
  result.header.stamp = ros::Time(seconds);
  result.child_frame_id = child;
  result.transform.translation.x = x;
  result.transform.rotation.w = 1.0;
  return result;
}

/// Odometry of a vehicle that has driven ahead at this speed (m/s) since the start, odom ->
/// base_link.
inline nav_msgs::Odometry odometry(double seconds, double speed) {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(seconds);
  message.header.frame_id = "odom";
  message.child_frame_id = "base_link";
  message.pose.pose.position.x = speed * (seconds - kStart);
  message.pose.pose.orientation.w = 1.0;
  message.twist.twist.linear.x = speed;
  return message;
}

inline tf2_msgs::TFMessage transforms(std::vector<geometry_msgs::TransformStamped> list) {
  tf2_msgs::TFMessage message;
  message.transforms = std::move(list);
  return message;
}

/// Returns the reason of the InputError that `call` throws; empty if it throws none.
inline std::string reasonOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.reason();
  }
  return "";
}

}  // namespace datmo::samples
