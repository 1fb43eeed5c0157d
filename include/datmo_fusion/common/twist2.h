// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Motion of a vehicle that does not slip sideways: speed along its heading, and turn rate.
struct Twist2 {
  double forward_speed = 0.0;  ///< m/s, positive ahead
  double yaw_rate = 0.0;       ///< rad/s, positive to the left
};

/// Where the vehicle's frame is after `seconds` of a constant twist, seen from where it was: an arc
/// of a circle (Thrun, Burgard, Fox, Probabilistic Robotics, 2005, eq. 5.9).
Pose2 arc(const Twist2& twist, double seconds);

/// The constant twist that leads to `motion` in `seconds` (more than 0); sideways motion that no
/// such twist explains is left out.
Twist2 twistOf(const Pose2& motion, double seconds);

}  // namespace datmo
