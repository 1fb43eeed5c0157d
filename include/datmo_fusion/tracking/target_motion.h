#pragma once

#include <array>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// How tracked objects move, the same for all of them.
struct TargetMotionOptions {
  double turn_rate = 0.4;             ///< rad/s
  double acceleration_density = 0.2;  ///< m^2/s^3
  double jerk_density = 1.0;          ///< m^2/s^5
  double acceleration_std = 0.5;      ///< m/s^2
  double acceleration_fading = 0.3;   ///< s

  void visit(OptionVisitor& visitor);
};

/// One linear motion over one time step: x' = transition x + w, w ~ N(0, noise).
struct LinearMotion {
  TrackCovariance transition;
  TrackCovariance noise;
};

/// Turn at a known rate (rad/s, positive to the left; 0: constant velocity) over `seconds` >= 0,
/// with white noise on the acceleration (Bar-Shalom, Li, Kirubarajan, Estimation with Applications
/// to Tracking and Navigation, 2001, 11.7.1).
///
/// The velocity turns; the state's acceleration does not drive it. That acceleration is the
/// centripetal one and a rest that the model does not explain, which fades exponentially to
/// N(0, acceleration_std^2). So all models share one state, no covariance becomes singular, and the
/// discretisation is exact: two steps equal one of their sum, and a step of 0 s changes nothing.
LinearMotion coordinatedTurn(double turn_rate, const TargetMotionOptions& options, double seconds);

/// Constant acceleration over `seconds` >= 0 with white noise on the jerk (ibid., 6.2.3).
LinearMotion constantAcceleration(const TargetMotionOptions& options, double seconds);

/// The four models in the order of MotionMode.
std::array<LinearMotion, kMotionModes> targetMotions(const TargetMotionOptions& options,
                                                     double seconds);

}  // namespace datmo
