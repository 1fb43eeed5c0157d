// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Motion parameters of tracked objects of one class.
struct TargetMotionOptions {
  double turn_rate = 0.4;             ///< rad/s
  double acceleration_density = 0.2;  ///< m^2/s^3
  double jerk_density = 1.0;          ///< m^2/s^5
  double acceleration_std = 0.5;      ///< m/s^2
  double acceleration_fading = 0.3;   ///< s
  double standing_speed_std = 0.03;   ///< m/s
  double standing_density = 1e-4;     ///< m^2/s
  /// s, 0.001 to 1: time constant with which the standing model forgets velocity and acceleration;
  /// well below the time between two scans
  double standing_fading = 0.02;
  double start_speed_std = 1.0;  ///< m/s

  void visit(OptionVisitor& visitor);
};

TargetMotionOptions pedestrianMotion();
TargetMotionOptions cyclistMotion();

/// A linear motion over one time step: x' = transition x + w, w ~ N(0, noise). No motion depends on
/// the position: the first two columns of the transition are those of the identity.
struct LinearMotion {
  TrackCovariance transition;
  TrackCovariance noise;
};

/// Returns the motion of a turn at a known rate (rad/s, positive to the left; 0: constant velocity)
/// over `seconds` >= 0, with white noise on the acceleration (Bar-Shalom, Li, Kirubarajan,
/// Estimation with Applications to Tracking and Navigation, 2001, 11.7.1).
///
/// The velocity turns; the acceleration in the state does not drive it. That acceleration is the
/// centripetal one plus an unmodeled remainder, which decays exponentially to
/// N(0, acceleration_std^2). So all models share one state, no covariance becomes singular, and the
/// discretization is exact: two steps equal one of their sum, and a step of 0 s changes nothing.
LinearMotion coordinatedTurn(double turn_rate, const TargetMotionOptions& options, double seconds);

/// Returns the motion at constant acceleration over `seconds` >= 0 with white noise on the jerk
/// (ibid., 6.2.3).
LinearMotion constantAcceleration(const TargetMotionOptions& options, double seconds);

/// Returns the motion of a standing object over `seconds` >= 0: the position stays, except for a
/// slow random walk of density `standing_density`, and velocity and acceleration decay
/// exponentially with `standing_fading` to a remainder of `standing_speed_std` (m/s, and the same
/// number in m/s^2) that keeps the covariance regular. Velocity left during the step does not move
/// the position: this models an object that has come to rest, not its braking. Discretized exactly,
/// as above.
LinearMotion standingStill(const TargetMotionOptions& options, double seconds);

/// Returns what is added to the variance of each component when an object starts moving: by the
/// end of the step it may have any velocity of `start_speed_std` and any acceleration of
/// `acceleration_std`.
TrackState startVariance(const TargetMotionOptions& options);

/// Returns all models in the order of MotionMode.
std::array<LinearMotion, kMotionModes> targetMotions(const TargetMotionOptions& options,
                                                     double seconds);

}  // namespace datmo
