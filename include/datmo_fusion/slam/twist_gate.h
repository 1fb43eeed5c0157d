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

  void visit(OptionVisitor& visitor);
};

/// Separates twists that a vehicle can have had from those of a broken message, by the twist
/// before and the time since then: what changed by more than its tires can do, and by more than
/// VelocityMotionModel's noise of a measurement explains, is not followed. If the next twist goes
/// on from there, the vehicle did change, and is followed again: a wrong one costs itself.
class TwistGate {
 public:
  /// Throws OptionError.
  explicit TwistGate(const TwistGateOptions& options);

  /// Whether this twist may be used. Finite; stamps rise.
  bool passes(Stamp stamp, const Twist2& twist);

  void reset();

 private:
  struct Measured {
    Stamp stamp;
    Twist2 twist;
  };

  bool canFollow(const std::optional<Measured>& from, const Measured& to) const;

  /// Standard deviations of speed (m/s) and yaw rate (rad/s), as of the greater of both.
  Eigen::Vector2d measurementNoise(const Twist2& one, const Twist2& other) const;

  TwistGateOptions options_;
  VelocityMotionModel noise_;
  std::optional<Measured> last_;     ///< that passed
  std::optional<Measured> refused_;  ///< since then
};

}  // namespace datmo
