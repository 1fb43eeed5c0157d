// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include <nav_msgs/Odometry.h>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo {

/// Detects odometry whose driver repeats its last measurement with new stamps: pose and twist are
/// bit for bit identical, although the pose must change while the vehicle moves.
///
/// Repetitions are accepted as long as a single sample may be held (MotionOptions::hold), since
/// some drivers publish faster than they measure. A driver whose pose is constant all the time is
/// not judged: its twist may be constant for many reasons.
class FrozenOdometry {
 public:
  /// `max_hold`: s.
  explicit FrozenOdometry(double max_hold) : max_hold_(max_hold) {}

  /// Stamps must rise. Returns whether the message repeats an earlier measurement, and so tells
  /// nothing about the motion at its stamp.
  bool update(const nav_msgs::Odometry& message);

  void reset() { *this = FrozenOdometry(max_hold_); }

 private:
  /// Position, orientation and twist in the plane.
  using Measured = std::array<double, 6>;

  double max_hold_;
  Measured last_{};
  Stamp first_stamp_;  ///< of the first with `last_`
  bool is_first_ = true;
  bool pose_counts_ = false;
};

}  // namespace datmo
