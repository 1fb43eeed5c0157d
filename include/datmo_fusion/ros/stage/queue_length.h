// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/convert/messages.h"

namespace datmo {

/// How many messages of a type may wait, so that memory is bounded and a hiccup costs nothing: a
/// second of motion input (a fast Imu), a second of scans and what is made of them, and a
/// few clouds or images, of several MB each.
template <typename Message>
constexpr std::uint32_t queueLength() {
  constexpr auto is_any_of = [](auto... same) { return (same || ...); };
  if constexpr (is_any_of(std::is_same_v<Message, nav_msgs::Odometry>,
                          std::is_same_v<Message, sensor_msgs::Imu>,
                          std::is_same_v<Message, sensor_msgs::JointState>,
                          std::is_same_v<Message, geometry_msgs::TwistStamped>,
                          std::is_same_v<Message, geometry_msgs::TwistWithCovarianceStamped>)) {
    return 200;
  } else if constexpr (is_any_of(std::is_same_v<Message, sensor_msgs::PointCloud2>,
                                 std::is_same_v<Message, sensor_msgs::Image>)) {
    return 5;
  } else {
    return 20;
  }
}

/// s of ROS time for which a message of a type may wait in the queue of a stage: longer than a
/// machine that keeps up ever lets one wait, and short enough that tracks are of now where it does
/// not. Without a bound for motion, all of which adds up, and for what is not replaced by the next.
template <typename Message>
constexpr double maxWaitInQueue() {
  constexpr auto is_any_of = [](auto... same) { return (same || ...); };
  const bool is_replaced = is_any_of(
      std::is_same_v<Message, sensor_msgs::LaserScan>,
      std::is_same_v<Message, sensor_msgs::MultiEchoLaserScan>,
      std::is_same_v<Message, sensor_msgs::PointCloud2>,
      std::is_same_v<Message, sensor_msgs::Image>, std::is_same_v<Message, LabeledScanMessage>,
      std::is_same_v<Message, ObjectArray>, std::is_same_v<Message, TrackArray>);
  return is_replaced ? 1.0 : std::numeric_limits<double>::infinity();
}

}  // namespace datmo
