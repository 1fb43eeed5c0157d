// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include <nav_msgs/Odometry.h>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo {

/// Knows odometry whose driver repeats its last measurement under new stamps: pose and twist bit
/// for bit the same, though a pose that counts cannot stay while the vehicle moves.
///
/// Repeated ones serve for as long as one serves that nothing comes after (MotionOptions::hold):
/// some drivers send more often than they measure. A driver that leaves the pose as it is all the
/// time is not judged: its twist may stay the same for many reasons.
class FrozenOdometry {
 public:
  /// `max_hold`: s.
  explicit FrozenOdometry(double max_hold) : max_hold_(max_hold) {}

  /// By rising stamp. Whether the message says nothing of its stamp.
  bool take(const nav_msgs::Odometry& message);

  void reset() { *this = FrozenOdometry(max_hold_); }

 private:
  /// Position, orientation and twist in the plane.
  using Measured = std::array<double, 6>;

  double max_hold_;
  Measured last_{};
  Stamp first_stamp_;  ///< of those with `last_`
  bool is_first_ = true;
  bool pose_counts_ = false;
};

}  // namespace datmo
