// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include <geometry_msgs/AccelWithCovarianceStamped.h>
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

/// Maximum number of waiting messages per type, so that memory is bounded and short delays lose
/// nothing: a second of motion input (a fast IMU), a second of scans and their results, and a few
/// clouds or images of several MB each.
template <typename Message>
constexpr std::uint32_t queueLength() {
  constexpr auto is_any_of = [](auto... same) { return (same || ...); };
  if constexpr (is_any_of(std::is_same_v<Message, nav_msgs::Odometry>,
                          std::is_same_v<Message, sensor_msgs::Imu>,
                          std::is_same_v<Message, sensor_msgs::JointState>,
                          std::is_same_v<Message, geometry_msgs::AccelWithCovarianceStamped>,
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

/// Maximum time in s of ROS time that a message of a type may wait in the queue of a stage: longer
/// than on a machine that keeps up, and short enough that tracks are current on one that does not.
/// Unlimited for motion, where every message counts, and for messages that the next one does not
/// replace.
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
