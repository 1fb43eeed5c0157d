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

/// Motion at constant velocities, sideways too: `motion` = x (m), y (m) and turn (rad) that the
/// moving frame itself would measure. The exponential map of SE(2) (Sola et al., A micro Lie theory
/// for state estimation in robotics, 2018, eq. 156).
Pose2 screw(const Eigen::Vector3d& motion);

/// The constant velocities, times their duration, that lead to this motion: screw(screwOf(m)) is m.
Eigen::Vector3d screwOf(const Pose2& motion);

}  // namespace datmo
