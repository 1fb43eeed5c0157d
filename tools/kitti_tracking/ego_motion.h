// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo::kitti {

struct EgoMotionOptions {
  double acceleration_std = 2.0;      ///< m/s^2
  double yaw_acceleration_std = 0.6;  ///< rad/s^2
  double first_speed_std = 15.0;      ///< m/s
  double first_yaw_rate_std = 0.2;    ///< rad/s
  double gate = 3.0;                  ///< m
  double outlier_distance = 3.0;      ///< 1
  int min_matches = 2;

  void visit(OptionVisitor& visitor);
};

/// A landmark at an uncertain position.
struct Landmark {
  Point2 position = Point2::Zero();                          ///< m
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< m^2
};

/// Estimates the vehicle's motion only from the objects that it sees: speed and yaw rate, predicted
/// as constant, are corrected so that previously seen objects coincide with those seen now. It is
/// an iterated extended Kalman filter in which the weight of a match decreases with its error
/// (weights of Geman and McClure 1985), so that neither wrong matches nor moving objects dominate.
///
/// The common motion of most objects is attributed to the vehicle: in a column of cars and nothing
/// else, the fixed frame moves with them. This does not matter for tracking objects relative to
/// each other.
class EgoMotion {
 public:
  /// Throws OptionError.
  explicit EgoMotion(const EgoMotionOptions& options);

  /// Advances by `seconds` (greater than 0). `expected`: last positions of objects, in the fixed
  /// frame; `seen`: present positions of objects, in the vehicle's frame. With too few matches, the
  /// motion continues unchanged.
  void step(double seconds, const std::vector<Landmark>& expected,
            const std::vector<Landmark>& seen);

  const Pose2& baseInFixed() const { return base_in_fixed_; }
  Twist2 twist() const { return {state_[0], state_[1]}; }

  /// Of speed (m/s) and yaw rate (rad/s).
  const Eigen::Matrix2d& covariance() const { return covariance_; }

 private:
  /// Forward speed and yaw rate.
  using State = Eigen::Vector2d;

  EgoMotionOptions options_;
  Pose2 base_in_fixed_;
  State state_ = State::Zero();
  Eigen::Matrix2d covariance_;
};

}  // namespace datmo::kitti
