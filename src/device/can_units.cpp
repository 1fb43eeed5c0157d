// SPDX-License-Identifier: BSD-3-Clause
#include "can_units.h"

#include "datmo_fusion/common/angle.h"

namespace datmo {

const Units& unitsOf(const std::string& quantity) {
  constexpr double kKilometersPerHour = 1.0 / 3.6;
  constexpr double kMilesPerHour = 0.44704;
  constexpr double kGravity = 9.80665;  // m/s^2
  static const std::map<std::string, Units> units = {
      {"speed",
       {{"m/s", 1.0},
        {"km/h", kKilometersPerHour},
        {"kph", kKilometersPerHour},
        {"mph", kMilesPerHour}}},
      {"turning", {{"rad/s", 1.0}, {"rpm", 2.0 * kPi / 60.0}, {"1/min", 2.0 * kPi / 60.0}}},
      {"acceleration", {{"m/s^2", 1.0}, {"m/s2", 1.0}, {"m/s/s", 1.0}, {"g", kGravity}}},
      {"rate",
       {{"rad/s", 1.0}, {"deg/s", degrees(1.0)}, {"°/s", degrees(1.0)}, {"\xB0/s", degrees(1.0)}}},
      {"angle",
       {{"rad", 1.0}, {"deg", degrees(1.0)}, {"°", degrees(1.0)}, {"\xB0", degrees(1.0)}}}};
  return units.at(quantity);
}

}  // namespace datmo
