// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Motion of a vehicle that does not slip sideways: speed along its heading, and yaw rate.
struct Twist2 {
  double forward_speed = 0.0;  ///< m/s, positive ahead
  double yaw_rate = 0.0;       ///< rad/s, positive to the left
};

/// Returns the pose of the vehicle's frame after `seconds` at a constant twist, relative to its
/// start: a circular arc (Thrun, Burgard, Fox, Probabilistic Robotics, 2005, eq. 5.9).
Pose2 arc(const Twist2& twist, double seconds);

/// Returns the constant twist that leads to `motion` in `seconds` (more than 0); sideways motion,
/// which no such twist explains, is ignored.
Twist2 twistOf(const Pose2& motion, double seconds);

/// Returns the motion at constant velocities, including sideways: `motion` = x (m), y (m) and turn
/// (rad), as measured in the moving frame itself. The exponential map of SE(2) (Sola et al., A
/// micro Lie theory for state estimation in robotics, 2018, eq. 156).
Pose2 screw(const Eigen::Vector3d& motion);

/// Returns the constant velocities, times their duration, that lead to this motion:
/// screw(screwOf(m)) is m.
Eigen::Vector3d screwOf(const Pose2& motion);

}  // namespace datmo
