// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/motion_model.h"

#include <cmath>

namespace datmo {

void OdometryNoiseOptions::visit(OptionVisitor& visitor) {
  visitor.number({"speed_noise", "m/s", "standard deviation of odometry's speed", Tier::kPublic},
                 speed_noise, {0.001, 10.0});
  visitor.number({"speed_noise_ratio", "1",
                  "standard deviation of odometry's speed, in addition, relative to "
                  "it: wheel radius, slip"},
                 speed_noise_ratio, {0.0, 1.0});
  visitor.number({"yaw_rate_noise", "rad/s", "standard deviation of its yaw rate, bias included",
                  Tier::kPublic},
                 yaw_rate_noise, {0.0001, 3.0});
  visitor.number({"yaw_rate_noise_ratio", "1",
                  "standard deviation of its yaw rate, in addition, relative to it"},
                 yaw_rate_noise_ratio, {0.0, 1.0});
}

Eigen::Matrix2d OdometryNoiseOptions::covariance(const Twist2& twist) const {
  const double speed = speed_noise + speed_noise_ratio * std::abs(twist.forward_speed);
  const double yaw_rate = yaw_rate_noise + yaw_rate_noise_ratio * std::abs(twist.yaw_rate);
  return Eigen::Vector2d(speed * speed, yaw_rate * yaw_rate).asDiagonal();
}

void MotionModelOptions::visit(OptionVisitor& visitor) {
  OdometryNoiseOptions::visit(visitor);
  visitor.number({"side_slip_noise", "m/s", "standard deviation of the lateral speed"},
                 side_slip_noise, {0.0001, 5.0});
  visitor.number({"acceleration_noise", "m/s^1.5", "without odometry: random walk of the speed",
                  Tier::kPublic},
                 acceleration_noise, {0.001, 50.0});
  visitor.number(
      {"yaw_acceleration_noise", "rad/s^1.5", "without odometry: random walk of the yaw rate"},
      yaw_acceleration_noise, {0.001, 50.0});
  visitor.number({"initial_speed_sigma", "m/s",
                  "without odometry: standard deviation of the speed at the start"},
                 initial_speed_sigma, {0.001, 100.0});
  visitor.number({"initial_yaw_rate_sigma", "rad/s",
                  "without odometry: standard deviation of the yaw rate at the start"},
                 initial_yaw_rate_sigma, {0.0001, 10.0});
}

VelocityMotionModel::VelocityMotionModel(const Checked<MotionModelOptions>& options)
    : options_(*options) {}

Eigen::Matrix3d VelocityMotionModel::covariance(const Twist2& twist, double seconds) const {
  // A constant error of the yaw rate also bends the path: half of it acts sideways.
  Eigen::Matrix<double, 3, 2> velocity_to_motion = Eigen::Matrix<double, 3, 2>::Zero();
  velocity_to_motion(0, 0) = seconds;
  velocity_to_motion(1, 1) = 0.5 * twist.forward_speed * seconds * seconds;
  velocity_to_motion(2, 1) = seconds;
  return velocity_to_motion * velocityCovariance(twist) * velocity_to_motion.transpose() +
         sideSlip(seconds);
}

Eigen::Matrix3d VelocityMotionModel::sideSlip(double seconds) const {
  const double sigma = options_.side_slip_noise * seconds;
  return Eigen::Vector3d(0.0, sigma * sigma, 0.0).asDiagonal();
}

Eigen::Matrix2d VelocityMotionModel::velocityChange(double seconds) const {
  const double speed = options_.acceleration_noise * options_.acceleration_noise;
  const double yaw_rate = options_.yaw_acceleration_noise * options_.yaw_acceleration_noise;
  return (seconds * Eigen::Vector2d(speed, yaw_rate)).asDiagonal();
}

Eigen::Matrix2d VelocityMotionModel::initialVelocityCovariance() const {
  const double speed = options_.initial_speed_sigma * options_.initial_speed_sigma;
  const double yaw_rate = options_.initial_yaw_rate_sigma * options_.initial_yaw_rate_sigma;
  return Eigen::Vector2d(speed, yaw_rate).asDiagonal();
}

}  // namespace datmo
