// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <type_traits>

#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/PointCloud2.h>

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

}  // namespace datmo
