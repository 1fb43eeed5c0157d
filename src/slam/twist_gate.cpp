// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/twist_gate.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

/// Standard deviations of a measured change that is within its noise: one in 1.7 million exceeds
/// it.
constexpr double kNoiseSigmas = 5.0;

}  // namespace

void TwistGateOptions::visit(OptionVisitor& visitor) {
  visitor.number({"max_acceleration", "m/s^2",
                  "odometry does not change its speed faster, except by noise; a twist that does "
                  "is not used until the next one agrees with it; 1.2 g: the best road tires"},
                 max_acceleration, {0.1, 1000.0});
  visitor.number({"max_yaw_acceleration", "rad/s^2",
                  "the same for its yaw rate; those tires at half of a car's wheelbase of 2.7 m"},
                 max_yaw_acceleration, {0.1, 1000.0});
  visitor.number({"min_turn_radius", "m",
                  "yaw rates of wider turns may occur at once, as far as the tires grip laterally "
                  "(max_acceleration); half of a car's turning circle of 10 m, at its rear axle"},
                 min_turn_radius, {0.01, 1000.0});
}

TwistGate::TwistGate(const TwistGateOptions& options, const OdometryNoiseOptions& noise)
    : options_(options), noise_(noise) {
  checkOptions(options);
  checkOptions(noise);
}

bool TwistGate::passes(Stamp stamp, const Twist2& twist, const Eigen::Vector2d& sigma) {
  const Measured measured{stamp, twist};
  if (last_ && !canFollow(last_, measured, sigma) && !canFollow(refused_, measured, sigma)) {
    refused_ = measured;
    return false;
  }
  last_ = measured;
  refused_.reset();
  return true;
}

bool TwistGate::canFollow(const std::optional<Measured>& from, const Measured& to,
                          const Eigen::Vector2d& sigma) const {
  if (!from) {
    return false;
  }
  const double seconds = secondsBetween(from->stamp, to.stamp);
  const Eigen::Vector2d noise = kNoiseSigmas * (measurementNoise(from->twist, to.twist) + sigma);
  const double speed_change = std::abs(to.twist.forward_speed - from->twist.forward_speed);
  const double yaw_rate_change = std::abs(to.twist.yaw_rate - from->twist.yaw_rate);
  return speed_change <= options_.max_acceleration * seconds + noise[0] &&
         (canSteer(to.twist) ||
          yaw_rate_change <= options_.max_yaw_acceleration * seconds + noise[1]);
}

bool TwistGate::canSteer(const Twist2& twist) const {
  const double speed = std::abs(twist.forward_speed);
  const double yaw_rate = std::abs(twist.yaw_rate);
  return yaw_rate * options_.min_turn_radius <= speed &&
         yaw_rate * speed <= options_.max_acceleration;
}

Eigen::Vector2d TwistGate::measurementNoise(const Twist2& one, const Twist2& other) const {
  const Twist2 greater{std::max(std::abs(one.forward_speed), std::abs(other.forward_speed)),
                       std::max(std::abs(one.yaw_rate), std::abs(other.yaw_rate))};
  return noise_.covariance(greater).diagonal().cwiseSqrt();
}

void TwistGate::reset() {
  last_.reset();
  refused_.reset();
}

}  // namespace datmo
