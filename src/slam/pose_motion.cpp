// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/pose_motion.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/slam/odometry_buffer.h"

namespace datmo {

namespace {

/// Standard deviations of speed (m/s) and yaw rate (rad/s) between two poses, from the more certain
/// one: what makes a pose uncertain is in both, until a correction removes it from the second.
Eigen::Vector2d twistSigma(const Eigen::Matrix3d& one, const Eigen::Matrix3d& other,
                           double seconds) {
  const auto variances = [](const Eigen::Matrix3d& covariance) {
    return Eigen::Vector2d(covariance.topLeftCorner<2, 2>().trace(), covariance(2, 2));
  };
  return (2.0 * variances(one).cwiseMin(variances(other)).cwiseMax(0.0)).cwiseSqrt() / seconds;
}

}  // namespace

PoseMotion::PoseMotion(const TwistGateOptions& change, const OdometryNoiseOptions& noise)
    : gate_(change, noise) {}

std::optional<PoseStep> PoseMotion::add(Stamp stamp, const PoseWithCovariance& pose) {
  const std::optional<Last> before = last_;
  last_ = {stamp, pose};
  if (!before) {
    return std::nullopt;
  }
  const double seconds = secondsBetween(before->stamp, stamp);
  const Pose2 motion = before->pose.pose.inverse() * pose.pose;
  PoseStep step;
  // The twist of an arc ignores a sideways jump.
  step.twist = {std::copysign(motion.position().norm() / seconds, motion.x()),
                twistOf(motion, seconds).yaw_rate};
  step.sigma = twistSigma(before->pose.covariance, pose.covariance, seconds);
  step.jumped = !isPlausible(step.twist) || !gate_.passes(stamp, step.twist, step.sigma);
  if (!step.jumped) {
    twist_ = twistOf(motion, seconds);
    step.twist = twist_;
  }
  traveled_ = traveled_ * (step.jumped ? arc(twist_, seconds) : motion);
  step.traveled = traveled_;
  return step;
}

void PoseMotion::reset() {
  gate_.reset();
  last_.reset();
  twist_ = {};
  traveled_ = {};
}

}  // namespace datmo
