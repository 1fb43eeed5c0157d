// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/slam/map_drift.h"
#include "datmo_fusion/slam/motion_model.h"

namespace datmo {

struct PoseFilterOptions {
  bool calibrate_odometry = true;

  void visit(OptionVisitor& visitor);
};

/// What odometry gets wrong all the time.
struct OdometryErrors {
  double speed_scale = 0.0;    ///< measured speed = (1 + speed_scale) * true speed
  double yaw_rate_bias = 0.0;  ///< rad/s; measured yaw rate = true yaw rate + yaw_rate_bias

  Twist2 correct(const Twist2& measured) const {
    return {measured.forward_speed / (1.0 + speed_scale), measured.yaw_rate - yaw_rate_bias};
  }
};

/// Extended Kalman filter over the vehicle's pose in the map, its velocity, and the systematic
/// errors of its odometry (wheel radius, bias of the yaw-rate sensor), which the scan matches make
/// observable. The thesis takes odometry as unbiased; a bias that each match has to take out again
/// leaves a part of itself in the map at every scan. Without odometry the velocity is a state that
/// the matches give, and that changes by a random walk.
///
/// Called by GridSlam: predict, match, correct.
class PoseFilter {
 public:
  /// At the origin, with a velocity of which little is known. Throws OptionError.
  PoseFilter(const Checked<PoseFilterOptions>& options, const MotionModelOptions& motion);

  const OdometryErrors& errors() const { return errors_; }
  PoseWithCovariance pose() const;

  /// Of odometry's scale error before any match.
  ScalePrior scalePrior() const;

  /// As odometry measured it last, or else from the matches.
  const Twist2& velocity() const { return velocity_; }

  /// After `seconds` (more than 0) of `motion`, measured by odometry and corrected by errors().
  void predictMeasured(const Pose2& motion, double seconds);

  /// The same for a motion whose turn alone was measured, and whose length is that of velocity().
  void predictTurn(const Pose2& motion, double seconds);

  /// After `seconds` (more than 0) without odometry.
  void predictUnmeasured(double seconds);

  /// Takes a velocity that odometry measured `age` (s, 0 or more) ago, corrected by errors(): what
  /// it was then, and a random walk since.
  void observeVelocity(const Twist2& measured, double age);

  /// After a gap of `seconds` (more than 0) in which nothing was measured: any path whose speed and
  /// yaw rate are random walks by the accelerations of the motion model. `velocity_after`: as
  /// odometry measures it at the gap's end; such a path is known at both ends (a Brownian bridge),
  /// and its position about four times as well.
  void predictGap(double seconds, const std::optional<Twist2>& velocity_after);

  /// The pose in a map that begins at it, or that it was found again in, with this covariance;
  /// what is known of velocity and odometry stays.
  void restartAt(const PoseWithCovariance& pose);

  /// Takes the pose that a match found from pose() as its prior.
  void correct(const PoseWithCovariance& matched);

 private:
  /// Order of the states: pose (x, y, heading), velocity, errors of the odometry.
  enum State { kX, kY, kHeading, kSpeed, kYawRate, kSpeedScale, kYawRateBias, kStates };
  using Covariance = Eigen::Matrix<double, kStates, kStates>;

  /// Moves the pose; `speed` and `yaw_rate` are the states that, by these factors, make the motion
  /// longer and turn it more.
  void move(const Pose2& motion, double seconds, State speed, double speed_factor, State yaw_rate,
            double yaw_rate_factor);
  void addPoseNoise(const Eigen::Matrix3d& motion_noise);
  /// What random walks of speed and yaw rate do to pose and velocity in a gap.
  void addWalkNoise(const Twist2& twist, double seconds);
  /// Adds a correction to all states.
  void apply(const Eigen::Matrix<double, kStates, 1>& step);
  /// How much the errors of the odometry may have changed.
  void addErrorDrift(double seconds);

  PoseFilterOptions options_;
  VelocityMotionModel motion_model_;
  Pose2 pose_;
  Twist2 velocity_;
  OdometryErrors errors_;
  Covariance covariance_ = Covariance::Zero();
};

}  // namespace datmo
