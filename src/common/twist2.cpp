// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/twist2.h"

#include <cmath>

namespace datmo {

namespace {

/// rad; below this turn, arc and chord lengths are equal in double precision.
constexpr double kStraight = 1e-9;

}  // namespace

Pose2 arc(const Twist2& twist, double seconds) {
  const double length = twist.forward_speed * seconds;
  const double turn = twist.yaw_rate * seconds;
  if (std::abs(turn) < kStraight) {
    return {length, 0.0, turn};
  }
  const double radius = length / turn;
  return {radius * std::sin(turn), radius * (1.0 - std::cos(turn)), turn};
}

Twist2 twistOf(const Pose2& motion, double seconds) {
  const double turn = motion.heading();
  const double half = 0.5 * turn;
  const double chord = motion.x() * std::cos(half) + motion.y() * std::sin(half);
  const double length = std::abs(half) < kStraight ? chord : chord * half / std::sin(half);
  return {length / seconds, turn / seconds};
}

Pose2 screw(const Eigen::Vector3d& motion) {
  const double half = 0.5 * motion[2];
  const double chord = std::abs(half) < kStraight ? 1.0 : std::sin(half) / half;
  return {Pose2(0.0, 0.0, half).rotate(chord * motion.head<2>()), motion[2]};
}

Eigen::Vector3d screwOf(const Pose2& motion) {
  const double half = 0.5 * motion.heading();
  const double chord = std::abs(half) < kStraight ? 1.0 : std::sin(half) / half;
  const Point2 straight = Pose2(0.0, 0.0, -half).rotate(motion.position()) / chord;
  return {straight.x(), straight.y(), motion.heading()};
}

}  // namespace datmo
