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

/// The vehicle's motion from nothing but the objects that it sees: speed and yaw rate, predicted as
/// constant, are corrected so that what stood around comes to lie on what is seen now. An iterated
/// extended Kalman filter in which a match counts the less the farther off it is (weights of Geman
/// and McClure 1985), so that neither wrong matches nor what moves by itself decide.
///
/// What most objects do alike, the vehicle is taken to do the other way round: in a column of cars
/// and nothing else, the fixed frame moves along with them. To follow objects relative to each
/// other that does not matter.
class EgoMotion {
 public:
  /// Throws OptionError.
  explicit EgoMotion(const EgoMotionOptions& options);

  /// Goes `seconds` (more than 0) ahead. `expected`: where objects were last, in the fixed frame;
  /// `seen`: where there are some now, in the vehicle's frame. With too few matches the motion goes
  /// on as it was.
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
