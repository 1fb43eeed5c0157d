// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/vehicle_sensors.h"

#include <cmath>

#include "datmo_fusion/common/angle.h"

namespace datmo::simulator {

void VehicleSensorOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"enabled", "", "/steering and /acceleration are recorded"}, enabled);
  visitor.number({"rate", "Hz", "measurements of steering and acceleration; assumed"}, rate,
                 {0.1, 1000.0});
  visitor.number(
      {"steering_noise", "deg", "standard deviation of the angle of the front wheels; assumed"},
      steering_noise, {0.0, 10.0});
  // Not 0: its message would have the covariance 0, which means unknown.
  visitor.number({"acceleration_noise", "m/s^2", "standard deviation; assumed"}, acceleration_noise,
                 {1e-3, 10.0});
  visitor.number({"wheelbase", "m", "distance between the axles"}, wheelbase, {0.1, 15.0});
}

VehicleSensors::VehicleSensors(const VehicleSensorOptions& options, const RandomStream& random)
    : options_(options), random_(random) {
  checkOptions(options_);
}

HostMeasurement VehicleSensors::measure(const WorldState& state) {
  const double speed = state.twist.forward_speed;
  if (speed != 0.0) {
    steering_ = std::atan(options_.wheelbase * state.twist.yaw_rate / speed);
  }
  const double acceleration = last_ ? (speed - last_->speed) / (state.time - last_->time) : 0.0;
  last_ = {state.time, speed};
  return {steering_ + random_.normal(degrees(options_.steering_noise)),
          acceleration + random_.normal(options_.acceleration_noise)};
}

}  // namespace datmo::simulator
