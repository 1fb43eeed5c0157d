// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/twist_gate.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

/// Standard deviations of a measured change that its noise alone explains: one in 1.7 million.
constexpr double kNoiseSigmas = 5.0;

}  // namespace

void TwistGateOptions::visit(OptionVisitor& visitor) {
  visitor.number({"max_acceleration", "m/s^2",
                  "no odometry changes its speed faster, but by noise; one that does is left out, "
                  "and followed when the next one goes on from it; 1.2 g: the best road tires"},
                 max_acceleration, {0.1, 1000.0});
  visitor.number({"max_yaw_acceleration", "rad/s^2",
                  "the same of its yaw rate; those tires at half of a car's wheelbase of 2.7 m"},
                 max_yaw_acceleration, {0.1, 1000.0});
}

TwistGate::TwistGate(const TwistGateOptions& options)
    : options_(options), noise_(MotionModelOptions()) {
  checkOptions(options);
}

bool TwistGate::passes(Stamp stamp, const Twist2& twist) {
  const Measured measured{stamp, twist};
  if (last_ && !canFollow(last_, measured) && !canFollow(refused_, measured)) {
    refused_ = measured;
    return false;
  }
  last_ = measured;
  refused_.reset();
  return true;
}

bool TwistGate::canFollow(const std::optional<Measured>& from, const Measured& to) const {
  if (!from) {
    return false;
  }
  const double seconds = secondsBetween(from->stamp, to.stamp);
  const Eigen::Vector2d noise = kNoiseSigmas * measurementNoise(from->twist, to.twist);
  const double speed_change = std::abs(to.twist.forward_speed - from->twist.forward_speed);
  const double yaw_rate_change = std::abs(to.twist.yaw_rate - from->twist.yaw_rate);
  return speed_change <= options_.max_acceleration * seconds + noise[0] &&
         yaw_rate_change <= options_.max_yaw_acceleration * seconds + noise[1];
}

Eigen::Vector2d TwistGate::measurementNoise(const Twist2& one, const Twist2& other) const {
  const Twist2 greater{std::max(std::abs(one.forward_speed), std::abs(other.forward_speed)),
                       std::max(std::abs(one.yaw_rate), std::abs(other.yaw_rate))};
  return noise_.velocityCovariance(greater).diagonal().cwiseSqrt();
}

void TwistGate::reset() {
  last_.reset();
  refused_.reset();
}

}  // namespace datmo
