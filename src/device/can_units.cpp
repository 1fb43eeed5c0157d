// SPDX-License-Identifier: BSD-3-Clause
#include "can_units.h"

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

Units speedUnits() {
  constexpr double kKilometersPerHour = 1.0 / 3.6;
  constexpr double kMilesPerHour = 0.44704;
  return {{"m/s", 1.0},
          {"km/h", kKilometersPerHour},
          {"kph", kKilometersPerHour},
          {"mph", kMilesPerHour}};
}

Units wheelSpeedUnits(double wheel_radius) {
  Units units = speedUnits();
  for (const auto& [turning, scale] :
       Units{{"rad/s", 1.0}, {"rpm", 2.0 * kPi / 60.0}, {"1/min", 2.0 * kPi / 60.0}}) {
    units.emplace(turning, scale * wheel_radius);
  }
  return units;
}

}  // namespace

Units unitsOf(CanQuantity quantity, double wheel_radius) {
  constexpr double kGravity = 9.80665;  // m/s^2
  switch (quantity) {
    case CanQuantity::kSpeed:
      return speedUnits();
    case CanQuantity::kWheelSpeed:
      return wheelSpeedUnits(wheel_radius);
    case CanQuantity::kYawRate:
      return {
          {"rad/s", 1.0}, {"deg/s", degrees(1.0)}, {"°/s", degrees(1.0)}, {"\xB0/s", degrees(1.0)}};
    case CanQuantity::kSteeringAngle:
      return {{"rad", 1.0}, {"deg", degrees(1.0)}, {"°", degrees(1.0)}, {"\xB0", degrees(1.0)}};
    case CanQuantity::kAcceleration:
      return {{"m/s^2", 1.0}, {"m/s2", 1.0}, {"m/s/s", 1.0}, {"g", kGravity}};
    case CanQuantity::kDirection:
      break;
  }
  return {};
}

}  // namespace datmo
