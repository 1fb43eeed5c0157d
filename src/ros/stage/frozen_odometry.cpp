// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/frozen_odometry.h"

#include <cmath>
#include <cstring>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo {

namespace {

/// m, rad, by the twist: over this distance wheel odometry changes, however coarse the encoders.
constexpr double kCountedDistance = 0.3;
constexpr double kCountedTurn = degrees(3.0);

/// The pose comes first.
constexpr std::size_t kPoseBytes = 4 * sizeof(double);

}  // namespace

bool FrozenOdometry::update(const nav_msgs::Odometry& message) {
  const auto& pose = message.pose.pose;
  const auto& twist = message.twist.twist;
  const Measured measured = {pose.position.x,    pose.position.y, pose.orientation.z,
                             pose.orientation.w, twist.linear.x,  twist.angular.z};
  const Stamp stamp = toStamp(message.header.stamp);
  // Compared as bytes, so that NaN equals itself.
  if (is_first_ || std::memcmp(measured.data(), last_.data(), sizeof(measured)) != 0) {
    pose_counts_ =
        pose_counts_ || (!is_first_ && std::memcmp(measured.data(), last_.data(), kPoseBytes) != 0);
    last_ = measured;
    first_stamp_ = stamp;
    is_first_ = false;
    return false;
  }
  const double age = secondsBetween(first_stamp_, stamp);
  return pose_counts_ && age > max_hold_ &&
         (std::abs(twist.linear.x) * age > kCountedDistance ||
          std::abs(twist.angular.z) * age > kCountedTurn);
}

}  // namespace datmo
