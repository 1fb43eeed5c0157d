// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/held_transform.h"

#include <algorithm>

#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

/// Scans count as silent when none was received for this many of their periods, and for this long
/// (s): no working scanner drops that many, and a camera of 10 Hz waits for at most three frames.
constexpr double kSilentPeriods = 3.0;
constexpr double kSilence = 0.3;

/// s: the longest gap of scans for which the pose error was measured (scripts/gaps).
constexpr double kLongest = 5.0;

}  // namespace

void HeldTransform::served(Stamp now) {
  if (served_) {
    const double step = std::max(0.0, secondsBetween(*served_, now));
    period_ = step_ > 0.0 ? std::min(step_, step) : step;  // a single gap is not a period
    step_ = step;
  }
  served_ = now;
}

std::optional<geometry_msgs::TransformStamped> HeldTransform::at(Stamp stamp, Stamp now) const {
  if (!last_ || !served_) {
    return std::nullopt;
  }
  const double silence = secondsBetween(*served_, now);
  if (silence < std::max(kSilence, kSilentPeriods * period_) || silence > kLongest) {
    return std::nullopt;
  }
  geometry_msgs::TransformStamped held = *last_;
  held.header.stamp = toTime(stamp);
  return held;
}

}  // namespace datmo
