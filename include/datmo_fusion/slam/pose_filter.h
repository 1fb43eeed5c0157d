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

/// Systematic errors of odometry.
struct OdometryErrors {
  double speed_scale = 0.0;    ///< measured speed = (1 + speed_scale) * true speed
  double yaw_rate_bias = 0.0;  ///< rad/s; measured yaw rate = true yaw rate + yaw_rate_bias

  Twist2 correct(const Twist2& measured) const {
    return {measured.forward_speed / (1.0 + speed_scale), measured.yaw_rate - yaw_rate_bias};
  }
};

/// Extended Kalman filter over the vehicle's pose in the map, its velocity, and the systematic
/// errors of its odometry (wheel radius, bias of the yaw-rate sensor), which scan matching makes
/// observable. The thesis assumes unbiased odometry; but if each match has to correct a bias, part
/// of it remains in the map at every scan. Without odometry, the velocity is a state that is
/// observed by the matches and changes by a random walk.
///
/// Called by GridSlam: predict, match, correct.
class PoseFilter {
 public:
  /// Order of the states: pose (x, y, heading), velocity, errors of the odometry.
  enum State { kX, kY, kHeading, kSpeed, kYawRate, kSpeedScale, kYawRateBias, kStates };
  using Covariance = Eigen::Matrix<double, kStates, kStates>;

  /// All that is estimated.
  struct Estimate {
    Pose2 pose;
    Twist2 velocity;
    OdometryErrors errors;
    Covariance covariance = Covariance::Zero();
  };

  /// Starts at the origin, with a nearly unknown velocity. Throws OptionError.
  PoseFilter(const Checked<PoseFilterOptions>& options, const MotionModelOptions& motion);

  Estimate estimate() const { return {pose_, velocity_, errors_, covariance_}; }
  /// Continues from the estimate of an earlier filter with the same options.
  void continueFrom(const Estimate& estimate);

  const OdometryErrors& errors() const { return errors_; }
  PoseWithCovariance pose() const;

  /// Returns the prior of odometry's scale error, before any match.
  ScalePrior scalePrior() const;

  /// Returns the velocity from the latest odometry, or else from the matches.
  const Twist2& velocity() const { return velocity_; }

  /// Predicts over `seconds` (more than 0) with `motion` from odometry, corrected by errors().
  void predictMeasured(const Pose2& motion, double seconds);

  /// The same for a motion of which only the turn was measured; its length follows velocity().
  void predictTurn(const Pose2& motion, double seconds);

  /// Predicts over `seconds` (more than 0) without odometry.
  void predictUnmeasured(double seconds);

  /// Updates with a velocity that odometry measured `age` (s, 0 or more) ago, corrected by
  /// errors(); a random walk since then adds to its noise.
  void observeVelocity(const Twist2& measured, double age);

  /// Predicts over a gap of `seconds` (more than 0) without any measurement: along any path whose
  /// speed and yaw rate are random walks given by the accelerations of the motion model.
  /// `velocity_after`: from odometry at the end of the gap; a path known at both ends is a Brownian
  /// bridge, and its position is known about four times as well.
  void predictGap(double seconds, const std::optional<Twist2>& velocity_after);

  /// Restarts at this pose and covariance, in a map that starts there or in which the vehicle was
  /// found again; the estimates of velocity and odometry errors are kept.
  void restartAt(const PoseWithCovariance& pose);

  /// Updates with the pose of a match for which pose() was the prior.
  void correct(const PoseWithCovariance& matched);

 private:
  /// Moves the pose; `speed` and `yaw_rate` are the states that, by these factors, lengthen the
  /// motion and turn it further.
  void move(const Pose2& motion, double seconds, State speed, double speed_factor, State yaw_rate,
            double yaw_rate_factor);
  void addPoseNoise(const Eigen::Matrix3d& motion_noise);
  /// Adds the effect of random walks of speed and yaw rate on pose and velocity in a gap.
  void addWalkNoise(const Twist2& twist, double seconds);
  /// Adds a correction to all states.
  void apply(const Eigen::Matrix<double, kStates, 1>& step);
  /// Adds the random walk of the odometry errors.
  void addErrorDrift(double seconds);

  PoseFilterOptions options_;
  VelocityMotionModel motion_model_;
  Pose2 pose_;
  Twist2 velocity_;
  OdometryErrors errors_;
  Covariance covariance_ = Covariance::Zero();
};

}  // namespace datmo
