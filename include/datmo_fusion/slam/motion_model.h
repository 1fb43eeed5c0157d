// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo {

/// Noise of odometry's speed and yaw rate.
struct OdometryNoiseOptions {
  double speed_noise = 0.1;         ///< m/s
  double speed_noise_ratio = 0.05;  ///< of the speed
  double yaw_rate_noise = 0.02;     ///< rad/s
  double yaw_rate_noise_ratio = 0.1;

  void visit(OptionVisitor& visitor);

  /// Returns the covariance of a measured speed (m/s) and yaw rate (rad/s).
  Eigen::Matrix2d covariance(const Twist2& twist) const;
};

struct MotionModelOptions : OdometryNoiseOptions {
  double side_slip_noise = 0.05;        ///< m/s, sideways
  double acceleration_noise = 3.0;      ///< m/s per square root of s
  double yaw_acceleration_noise = 0.5;  ///< rad/s per square root of s
  double initial_speed_sigma = 10.0;    ///< m/s
  double initial_yaw_rate_sigma = 0.3;  ///< rad/s

  void visit(OptionVisitor& visitor);
};

/// Velocity motion model given odometry: p(x_t | u_t, x_t-1) of thesis 3.1.1, figure 3.1; that of
/// Probabilistic Robotics (Thrun et al. 2005, 5.3) with separate noise for side slip.
class VelocityMotionModel {
 public:
  /// Throws OptionError.
  explicit VelocityMotionModel(const Checked<MotionModelOptions>& options);

  /// Returns the covariance of x, y (m), heading (rad) after `seconds` at this twist, in the frame
  /// of the resulting pose.
  Eigen::Matrix3d covariance(const Twist2& twist, double seconds) const;

  /// Returns the part of it that is caused by neither speed nor yaw rate.
  Eigen::Matrix3d sideSlip(double seconds) const;

  /// Returns the covariance of speed (m/s) and yaw rate (rad/s) as measured by odometry.
  Eigen::Matrix2d velocityCovariance(const Twist2& twist) const {
    return options_.OdometryNoiseOptions::covariance(twist);
  }

  /// Returns the covariance of their change in this time, without odometry.
  Eigen::Matrix2d velocityChange(double seconds) const;

  /// Returns their covariance at the start, when nothing is known.
  Eigen::Matrix2d initialVelocityCovariance() const;

 private:
  MotionModelOptions options_;
};

}  // namespace datmo
