// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/pose_filter.h"

#include <cmath>
#include <vector>

#include <Eigen/LU>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/slam/pose_covariance.h"

namespace datmo {

namespace {

/// Random walk of the speed's scale, 1/s^0.5.
constexpr double kSpeedScaleDrift = 0.0005;

/// Standard deviation of the speed's scale at the start.
constexpr double kSpeedScaleSigma = 0.05;

/// Random walk of the yaw rate's bias, rad/s^1.5.
constexpr double kYawRateBiasDrift = 0.0005;

/// Standard deviation of the yaw rate's bias at the start, rad/s.
constexpr double kYawRateBiasSigma = 0.02;

}  // namespace

void PoseFilterOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"calibrate_odometry", "",
                  "estimate the odometry's scale error and yaw-rate bias online; false: assume "
                  "that it is unbiased (thesis)"},
                 calibrate_odometry);
}

PoseFilter::PoseFilter(const Checked<PoseFilterOptions>& options, const MotionModelOptions& motion)
    : options_(*options), motion_model_(motion) {
  covariance_.block<2, 2>(kSpeed, kSpeed) = motion_model_.initialVelocityCovariance();
  if (options_.calibrate_odometry) {
    covariance_(kSpeedScale, kSpeedScale) = square(kSpeedScaleSigma);
    covariance_(kYawRateBias, kYawRateBias) = kYawRateBiasSigma * kYawRateBiasSigma;
  }
}

ScalePrior PoseFilter::scalePrior() const {
  return {square(kSpeedScaleSigma), options_.calibrate_odometry};
}

void PoseFilter::continueFrom(const Estimate& estimate) {
  pose_ = estimate.pose;
  velocity_ = estimate.velocity;
  errors_ = estimate.errors;
  covariance_ = estimate.covariance;
}

PoseWithCovariance PoseFilter::pose() const { return {pose_, covariance_.topLeftCorner<3, 3>()}; }

void PoseFilter::move(const Pose2& motion, double seconds, State speed, double speed_factor,
                      State yaw_rate, double yaw_rate_factor) {
  const Pose2 next = pose_ * motion;
  const Point2 along = next.rotate(Point2(1.0, 0.0));
  const Point2 aside = next.rotate(Point2(0.0, 1.0));
  Covariance transition = Covariance::Identity();
  // An error of the heading rotates the motion.
  transition(kX, kHeading) = pose_.y() - next.y();
  transition(kY, kHeading) = next.x() - pose_.x();
  transition.block<2, 1>(kX, speed) = speed_factor * seconds * along;
  // A turn bends the path, so half of it also moves the vehicle sideways.
  const double length = twistOf(motion, seconds).forward_speed * seconds;
  transition.block<2, 1>(kX, yaw_rate) = 0.5 * yaw_rate_factor * length * seconds * aside;
  transition(kHeading, yaw_rate) = yaw_rate_factor * seconds;
  covariance_ = transition * covariance_ * transition.transpose();
  pose_ = next;
}

void PoseFilter::addPoseNoise(const Eigen::Matrix3d& motion_noise) {
  Eigen::Matrix3d to_map = Eigen::Matrix3d::Identity();
  to_map.topLeftCorner<2, 2>() = pose_.rotation();
  covariance_.topLeftCorner<3, 3>() += to_map * motion_noise * to_map.transpose();
}

void PoseFilter::predictMeasured(const Pose2& motion, double seconds) {
  const Twist2 twist = twistOf(motion, seconds);
  // A larger scale or bias means that the true motion was shorter, or turned less.
  const double speed_factor = -twist.forward_speed / (1.0 + errors_.speed_scale);
  move(motion, seconds, kSpeedScale, speed_factor, kYawRateBias, -1.0);
  addPoseNoise(motion_model_.covariance(twist, seconds));
  addErrorDrift(seconds);
  // The velocity is that of odometry, whatever the prior.
  velocity_ = twist;
  covariance_.middleRows<2>(kSpeed).setZero();
  covariance_.middleCols<2>(kSpeed).setZero();
  covariance_.block<2, 2>(kSpeed, kSpeed) = motion_model_.velocityCovariance(twist);
}

void PoseFilter::addErrorDrift(double seconds) {
  if (options_.calibrate_odometry) {
    covariance_(kSpeedScale, kSpeedScale) += kSpeedScaleDrift * kSpeedScaleDrift * seconds;
    covariance_(kYawRateBias, kYawRateBias) += kYawRateBiasDrift * kYawRateBiasDrift * seconds;
  }
}

void PoseFilter::predictTurn(const Pose2& motion, double seconds) {
  const Twist2 twist = twistOf(motion, seconds);
  covariance_(kSpeed, kSpeed) += motion_model_.velocityChange(seconds)(0, 0);
  move(motion, seconds, kSpeed, 1.0, kYawRateBias, -1.0);
  // The part of the motion noise that is caused by the yaw rate, without the speed, which is a
  // state.
  Eigen::Matrix3d noise = motion_model_.covariance(twist, seconds);
  noise(0, 0) = 0.0;
  addPoseNoise(noise);
  addErrorDrift(seconds);
  velocity_.yaw_rate = twist.yaw_rate;
  covariance_.row(kYawRate).setZero();
  covariance_.col(kYawRate).setZero();
  covariance_(kYawRate, kYawRate) = motion_model_.velocityCovariance(twist)(1, 1);
}

void PoseFilter::predictUnmeasured(double seconds) {
  covariance_.block<2, 2>(kSpeed, kSpeed) += motion_model_.velocityChange(seconds);
  move(arc(velocity_, seconds), seconds, kSpeed, 1.0, kYawRate, 1.0);
  addPoseNoise(motion_model_.sideSlip(seconds));
}

void PoseFilter::predictGap(double seconds, const std::optional<Twist2>& velocity_after) {
  // Mean velocity of a random walk between two known ends, or from a single one.
  const Twist2 after = velocity_after ? errors_.correct(*velocity_after) : velocity_;
  const Twist2 mean{0.5 * (velocity_.forward_speed + after.forward_speed),
                    0.5 * (velocity_.yaw_rate + after.yaw_rate)};
  move(arc(mean, seconds), seconds, kSpeed, 1.0, kYawRate, 1.0);
  addWalkNoise(mean, seconds);
  addPoseNoise(motion_model_.sideSlip(seconds));
  addErrorDrift(seconds);
  velocity_ = after;
  if (velocity_after) {
    observeVelocity(after, 0.0);
  }
}

void PoseFilter::addWalkNoise(const Twist2& twist, double seconds) {
  // Integrals of a Wiener process of this variance per second (Bar-Shalom, Li & Kirubarajan, 2001,
  // 6.2.2), up to the third for the yaw rate: the heading error leads sideways.
  const Eigen::Matrix2d walk = motion_model_.velocityChange(1.0);
  const double t = seconds;
  const double v = twist.forward_speed;
  Eigen::Matrix2d along;
  along << t * t * t / 3.0, t * t / 2.0, t * t / 2.0, t;
  Eigen::Matrix3d turn;
  turn << v * v * std::pow(t, 5) / 20.0, v * std::pow(t, 4) / 8.0, v * std::pow(t, 3) / 6.0,
      v * std::pow(t, 4) / 8.0, t * t * t / 3.0, t * t / 2.0, v * std::pow(t, 3) / 6.0, t * t / 2.0,
      t;
  const std::vector<int> speed_states{kX, kSpeed};
  const std::vector<int> turn_states{kY, kHeading, kYawRate};
  Eigen::Matrix<double, 5, 5> noise = Eigen::Matrix<double, 5, 5>::Zero();
  noise(speed_states, speed_states) = walk(0, 0) * along;
  noise(turn_states, turn_states) = walk(1, 1) * turn;
  Eigen::Matrix<double, 5, 5> to_map = Eigen::Matrix<double, 5, 5>::Identity();
  to_map.topLeftCorner<2, 2>() = pose_.rotation();
  covariance_.topLeftCorner<5, 5>() += to_map * noise * to_map.transpose();
}

void PoseFilter::observeVelocity(const Twist2& measured, double age) {
  const Eigen::Matrix2d innovation = covariance_.block<2, 2>(kSpeed, kSpeed) +
                                     motion_model_.velocityCovariance(measured) +
                                     motion_model_.velocityChange(age);
  const Eigen::Matrix<double, kStates, 2> gain =
      covariance_.middleCols<2>(kSpeed) * innovation.inverse();
  apply(gain * Eigen::Vector2d(measured.forward_speed - velocity_.forward_speed,
                               measured.yaw_rate - velocity_.yaw_rate));
  covariance_ -= gain * innovation * gain.transpose();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
}

void PoseFilter::apply(const Eigen::Matrix<double, kStates, 1>& step) {
  pose_ = Pose2(pose_.x() + step[kX], pose_.y() + step[kY], pose_.heading() + step[kHeading]);
  velocity_.forward_speed += step[kSpeed];
  velocity_.yaw_rate += step[kYawRate];
  errors_.speed_scale += step[kSpeedScale];
  errors_.yaw_rate_bias += step[kYawRateBias];
}

void PoseFilter::restartAt(const PoseWithCovariance& pose) {
  pose_ = pose.pose;
  covariance_.topRows<3>().setZero();
  covariance_.leftCols<3>().setZero();
  covariance_.topLeftCorner<3, 3>() = pose.covariance;
}

void PoseFilter::correct(const PoseWithCovariance& matched) {
  const Eigen::Matrix3d prior = covariance_.topLeftCorner<3, 3>();
  // Propagates the correction of the pose to all correlated states.
  const Eigen::Matrix<double, kStates, 3> gain = covariance_.leftCols<3>() * prior.inverse();
  apply(gain * differenceOf(pose_, matched.pose));
  covariance_ -= gain * (prior - matched.covariance) * gain.transpose();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  pose_ = matched.pose;
}

}  // namespace datmo
