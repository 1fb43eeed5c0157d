// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo {

/// How far odometry's speed and yaw rate are off.
struct OdometryNoiseOptions {
  double speed_noise = 0.1;         ///< m/s
  double speed_noise_ratio = 0.05;  ///< of the speed
  double yaw_rate_noise = 0.02;     ///< rad/s
  double yaw_rate_noise_ratio = 0.1;

  void visit(OptionVisitor& visitor);

  /// Covariance of speed (m/s) and yaw rate (rad/s) that were measured as this.
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

/// How a vehicle may have moved, given what its odometry says: p(x_t | u_t, x_t-1) of thesis 3.1.1,
/// figure 3.1; the velocity motion model of Probabilistic Robotics (Thrun et al. 2005, 5.3) with
/// noise of its own for side slip.
class VelocityMotionModel {
 public:
  /// Throws OptionError.
  explicit VelocityMotionModel(const Checked<MotionModelOptions>& options);

  /// Covariance of x, y (m), heading (rad) of the motion after `seconds` of this twist, in the
  /// frame of the pose that it leads to.
  Eigen::Matrix3d covariance(const Twist2& twist, double seconds) const;

  /// The part of it that neither speed nor yaw rate makes.
  Eigen::Matrix3d sideSlip(double seconds) const;

  /// Covariance of speed (m/s) and yaw rate (rad/s) that odometry measured as this.
  Eigen::Matrix2d velocityCovariance(const Twist2& twist) const {
    return options_.OdometryNoiseOptions::covariance(twist);
  }

  /// How much they may have changed in this time, where there is no odometry.
  Eigen::Matrix2d velocityChange(double seconds) const;

  /// Before anything is known of them.
  Eigen::Matrix2d initialVelocityCovariance() const;

 private:
  MotionModelOptions options_;
};

}  // namespace datmo
