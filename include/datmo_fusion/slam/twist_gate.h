// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/slam/motion_model.h"

namespace datmo {

/// Limits of a vehicle's dynamics.
struct TwistGateOptions {
  double max_acceleration = 12.0;     ///< m/s^2
  double max_yaw_acceleration = 9.0;  ///< rad/s^2
  double min_turn_radius = 4.0;       ///< m

  void visit(OptionVisitor& visitor);
};

/// Separates plausible twists of a vehicle from those of broken messages, by the previous twist and
/// the time since: a change that exceeds both what the tires allow and the measurement noise is
/// rejected. If the next twist is consistent with the rejected one, the vehicle did change, and is
/// followed again: a wrong twist costs only itself.
///
/// A yaw rate that steering and lateral grip allow is always accepted, however quickly it changed
/// (a steering wheel turned between two messages, a path of arcs): it is within what a vehicle can
/// do.
class TwistGate {
 public:
  /// Throws OptionError.
  TwistGate(const TwistGateOptions& options, const OdometryNoiseOptions& noise);

  /// Returns whether this twist may be used; it must be finite, with ascending stamps. `sigma`:
  /// standard deviations of speed (m/s) and yaw rate (rad/s) in addition to the noise.
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
  /// Whether steering and tires allow this yaw rate at this speed.
  bool canSteer(const Twist2& twist) const;

  /// Standard deviations of speed (m/s) and yaw rate (rad/s), at the greater of both twists.
  Eigen::Vector2d measurementNoise(const Twist2& one, const Twist2& other) const;

  TwistGateOptions options_;
  OdometryNoiseOptions noise_;
  std::optional<Measured> last_;     ///< last accepted twist
  std::optional<Measured> refused_;  ///< last rejected twist since then
};

}  // namespace datmo
