// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

namespace datmo {

/// Factors to m, s and rad, by unit name.
using Units = std::map<std::string, double>;

/// What a signal of a CAN bus measures.
enum class CanQuantity {
  kSpeed,
  kWheelSpeed,  ///< as a speed, or as the rate at which the wheel turns
  kYawRate,
  kSteeringAngle,
  kAcceleration,
  kDirection  ///< a code, without a unit of its own
};

/// Returns the units of a quantity; none for kDirection. `wheel_radius`: m.
Units unitsOf(CanQuantity quantity, double wheel_radius);

}  // namespace datmo
