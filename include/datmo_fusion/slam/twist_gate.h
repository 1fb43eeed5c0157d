// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/slam/motion_model.h"

namespace datmo {

/// What a vehicle can do to its velocity.
struct TwistGateOptions {
  double max_acceleration = 12.0;     ///< m/s^2
  double max_yaw_acceleration = 9.0;  ///< rad/s^2
  double min_turn_radius = 4.0;       ///< m

  void visit(OptionVisitor& visitor);
};

/// Separates twists that a vehicle can have had from those of a broken message, by the twist
/// before and the time since then: what changed by more than its tires can do, and by more than
/// the noise of the measurements explains, is not followed. If the next twist goes on from there,
/// the vehicle did change, and is followed again: a wrong one costs itself.
///
/// A yaw rate that fits the wheels' turn and the tires' grip sideways passes however fast it came:
/// a steering wheel turned between two messages, a path of arcs. It is no more wrong than a vehicle
/// can be.
class TwistGate {
 public:
  /// Throws OptionError.
  TwistGate(const TwistGateOptions& options, const OdometryNoiseOptions& noise);

  /// Whether this twist may be used. Finite; stamps rise. `sigma`: standard deviations of speed
  /// (m/s) and yaw rate (rad/s) besides the noise.
  bool passes(Stamp stamp, const Twist2& twist,
              const Eigen::Vector2d& sigma = Eigen::Vector2d::Zero());

  void reset();

 private:
  struct Measured {
    Stamp stamp;
    Twist2 twist;
  };

  bool canFollow(const std::optional<Measured>& from, const Measured& to,
                 const Eigen::Vector2d& sigma) const;
  /// Whether wheels and tires allow this yaw rate at this speed.
  bool canSteer(const Twist2& twist) const;

  /// Standard deviations of speed (m/s) and yaw rate (rad/s), as of the greater of both.
  Eigen::Vector2d measurementNoise(const Twist2& one, const Twist2& other) const;

  TwistGateOptions options_;
  OdometryNoiseOptions noise_;
  std::optional<Measured> last_;     ///< that passed
  std::optional<Measured> refused_;  ///< since then
};

}  // namespace datmo
