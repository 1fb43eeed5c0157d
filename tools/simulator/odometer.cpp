// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/odometer.h"

namespace datmo::simulator {

void OdometerOptions::visit(OptionVisitor& visitor) {
  visitor.number({"rate", "Hz", "measurements of speed and yaw rate; assumed"}, rate,
                 {0.1, 1000.0});
  visitor.number({"speed_scale_error", "1",
                  "measured speed is too large by this share of it (tire radius); assumed"},
                 speed_scale_error, {-0.5, 0.5});
  visitor.number({"speed_noise", "m/s", "standard deviation; assumed"}, speed_noise, {0.0, 10.0});
  visitor.number({"yaw_rate_bias", "deg/s", "constant error; assumed"}, yaw_rate_bias,
                 {-20.0, 20.0});
  visitor.number({"yaw_rate_noise", "deg/s", "standard deviation; assumed"}, yaw_rate_noise,
                 {0.0, 20.0});
}

Odometer::Odometer(const OdometerOptions& options, const RandomStream& random)
    : options_(options), random_(random) {
  checkOptions(options_);
}

Odometry Odometer::measure(const WorldState& state) {
  const double scale = options_.speed_scale_error;
  const double bias = degrees(options_.yaw_rate_bias);
  const double yaw_rate_noise = degrees(options_.yaw_rate_noise);
  const Twist2 truth =
      last_ ? twistOf(last_base_.inverse() * state.base, state.time - last_->time) : state.twist;
  Odometry now;
  now.time = state.time;
  now.twist.forward_speed =
      truth.forward_speed * (1.0 + scale) + random_.normal(options_.speed_noise);
  now.twist.yaw_rate = truth.yaw_rate + bias + random_.normal(yaw_rate_noise);
  now.speed_variance = options_.speed_noise * options_.speed_noise +
                       scale * scale * now.twist.forward_speed * now.twist.forward_speed;
  now.yaw_rate_variance = yaw_rate_noise * yaw_rate_noise + bias * bias;
  integrate(now);
  last_ = now;
  last_base_ = state.base;
  return now;
}

/// First-order propagation (Thrun, Burgard, Fox, Probabilistic Robotics, 2005, eq. 7.8 to 7.15).
void Odometer::integrate(Odometry& now) const {
  if (!last_) {
    return;
  }
  const double seconds = now.time - last_->time;
  const Pose2& before = last_->pose.pose;
  now.pose.pose = before * arc(now.twist, seconds);
  const Point2 moved = now.pose.pose.position() - before.position();
  Eigen::Matrix3d by_pose = Eigen::Matrix3d::Identity();
  by_pose(0, 2) = -moved.y();
  by_pose(1, 2) = moved.x();
  const Point2 ahead = now.pose.pose.rotate(Point2::UnitX());
  const Eigen::Vector3d by_speed = seconds * Eigen::Vector3d(ahead.x(), ahead.y(), 0.0);
  const Eigen::Vector3d by_yaw_rate =
      seconds * Eigen::Vector3d(-0.5 * moved.y(), 0.5 * moved.x(), 1.0);
  now.pose.covariance = by_pose * last_->pose.covariance * by_pose.transpose() +
                        now.speed_variance * by_speed * by_speed.transpose() +
                        now.yaw_rate_variance * by_yaw_rate * by_yaw_rate.transpose();
}

}  // namespace datmo::simulator
