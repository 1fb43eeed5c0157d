// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace datmo {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kQuarterTurn = 0.5 * kPi;  ///< rad
inline constexpr double kTurn = 2.0 * kPi;         ///< rad

/// Converts degrees to radians.
constexpr double degrees(double value) { return value * kPi / 180.0; }

/// Converts radians to degrees.
constexpr double toDegrees(double radians) { return radians * 180.0 / kPi; }

/// Returns the same direction in (-pi, pi]. `angle`: rad, any finite value.
inline double normalizeAngle(double angle) {
  if (angle > -kPi && angle <= kPi) {
    return angle;  // the common case; the remainder is slow
  }
  const double wrapped = std::remainder(angle, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

/// Returns the shortest rotation from one direction to another, rad, in (-pi, pi].
inline double angleBetween(double from, double to) { return normalizeAngle(to - from); }

}  // namespace datmo
