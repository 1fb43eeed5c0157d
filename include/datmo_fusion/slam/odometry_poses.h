// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo {

/// The vehicle's poses in its odometry frame over the last kOdometryMemory seconds.
class OdometryPoses {
 public:
  /// `hold`: how long (s) before and after its stamp a pose is used, moved by its twist.
  explicit OdometryPoses(double hold) : hold_(hold) {}

  /// Adds a pose, in ascending stamp order.
  void add(Stamp stamp, const Twist2& twist, const Pose2& base_in_odom);

  /// Returns the pose at a stamp, from the last one up to it, or else the first one after it; none
  /// if that is too far away in time.
  std::optional<Pose2> at(Stamp stamp) const;

  void clear() { poses_.clear(); }

 private:
  struct MovingPose {
    Stamp stamp;
    Twist2 twist;
    Pose2 base_in_odom;
  };

  double hold_;
  std::deque<MovingPose> poses_;
};

}  // namespace datmo
