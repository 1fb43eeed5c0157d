// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "simulator/random_stream.h"
#include "simulator/world.h"

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo::simulator {

/// The vehicle's own measurement of speed and yaw rate, and its errors. The defaults are assumed:
/// a passenger car's wheel speeds and yaw-rate sensor.
struct OdometerOptions {
  double rate = 50.0;               ///< Hz
  double speed_scale_error = 0.01;  ///< of the speed
  double speed_noise = 0.05;        ///< m/s
  double yaw_rate_bias = 0.1;       ///< deg/s
  double yaw_rate_noise = 0.2;      ///< deg/s

  void visit(OptionVisitor& visitor);
};

/// One measurement, and the pose integrated from the measurements so far.
///
/// The variances include scale error and bias as noise, because users of the odometry do not know
/// them.
struct Odometry {
  double time = 0.0;               ///< s
  Twist2 twist;                    ///< measured
  double speed_variance = 0.0;     ///< (m/s)^2
  double yaw_rate_variance = 0.0;  ///< (rad/s)^2
  PoseWithCovariance pose;  ///< of the vehicle in the odometry's frame, which is its initial pose
};

/// Measures the ego vehicle's mean motion since the previous measurement, like wheel counters, and
/// integrates it.
class Odometer {
 public:
  /// Throws OptionError.
  Odometer(const OdometerOptions& options, const RandomStream& random);

  /// States must be given in order of time.
  Odometry measure(const WorldState& state);

 private:
  void integrate(Odometry& now) const;

  OdometerOptions options_;
  RandomStream random_;
  std::optional<Odometry> last_;
  Pose2 last_base_;  // true, at the last measurement
};

}  // namespace datmo::simulator
