// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/odometry_poses.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "datmo_fusion/slam/odometry_buffer.h"

namespace datmo {

void OdometryPoses::add(Stamp stamp, const Twist2& twist, const Pose2& base_in_odom) {
  poses_.push_back({stamp, twist, base_in_odom});
  while (secondsBetween(poses_.front().stamp, stamp) > kOdometryMemory) {
    poses_.pop_front();
  }
}

std::optional<Pose2> OdometryPoses::at(Stamp stamp) const {
  const auto later =
      std::upper_bound(poses_.begin(), poses_.end(), stamp,
                       [](Stamp at, const MovingPose& pose) { return at < pose.stamp; });
  const auto nearest = later == poses_.begin() ? later : std::prev(later);
  if (nearest == poses_.end()) {
    return std::nullopt;
  }
  const double seconds = secondsBetween(nearest->stamp, stamp);
  if (std::abs(seconds) > hold_) {
    return std::nullopt;
  }
  return nearest->base_in_odom * arc(nearest->twist, seconds);
}

}  // namespace datmo
