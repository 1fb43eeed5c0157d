// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "simulator/random_stream.h"
#include "simulator/world.h"

#include "datmo_fusion/common/options.h"

namespace datmo::simulator {

/// What the host vehicle measures besides its odometry: the angle of the front wheels and the
/// acceleration. The noises are assumed: a steering angle sensor behind the steering gear, and an
/// accelerometer on a level road.
struct VehicleSensorOptions {
  bool enabled = false;
  double rate = 50.0;               ///< Hz
  double steering_noise = 0.2;      ///< deg
  double acceleration_noise = 0.2;  ///< m/s^2
  double wheelbase = 2.7;           ///< m

  void visit(OptionVisitor& visitor);
};

/// One measurement.
struct HostMeasurement {
  double steering = 0.0;      ///< rad, of the front wheels of a bicycle, positive to the left
  double acceleration = 0.0;  ///< m/s^2, along the heading
};

/// Measures the current steering angle, which a stationary vehicle keeps, and the mean acceleration
/// since the previous measurement.
class VehicleSensors {
 public:
  /// Throws OptionError.
  VehicleSensors(const VehicleSensorOptions& options, const RandomStream& random);

  /// States must be given in order of time.
  HostMeasurement measure(const WorldState& state);

 private:
  struct StampedSpeed {
    double time = 0.0;   ///< s
    double speed = 0.0;  ///< m/s
  };

  VehicleSensorOptions options_;
  RandomStream random_;
  std::optional<StampedSpeed> last_;
  double steering_ = 0.0;  ///< rad, true
};

}  // namespace datmo::simulator
