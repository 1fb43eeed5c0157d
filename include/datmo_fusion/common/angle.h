// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace datmo {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kQuarterTurn = 0.5 * kPi;  ///< rad
inline constexpr double kTurn = 2.0 * kPi;         ///< rad

/// Degrees to radians.
constexpr double degrees(double value) { return value * kPi / 180.0; }

/// Radians to degrees.
constexpr double toDegrees(double radians) { return radians * 180.0 / kPi; }

/// The same direction in (-pi, pi]. `angle` in rad, any finite value.
inline double normalizeAngle(double angle) {
  if (angle > -kPi && angle <= kPi) {
    return angle;  // most are: the remainder is slow
  }
  const double wrapped = std::remainder(angle, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

/// Shortest rotation from one direction to another, rad in (-pi, pi].
inline double angleBetween(double from, double to) { return normalizeAngle(to - from); }

}  // namespace datmo
