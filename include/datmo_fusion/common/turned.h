// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Returns the vector turned left by an angle (rad). Small angles, as of one step of a motion, are
/// accurate to 1e-5 and much faster, thanks to the sine's and cosine's series.
inline Point2 turned(const Point2& vector, double angle) {
  constexpr double kSmall = 0.1;  // rad
  const double square = angle * angle;
  const bool small = std::abs(angle) < kSmall;
  const double c = small ? 1.0 - 0.5 * square : std::cos(angle);
  const double s = small ? angle * (1.0 - square / 6.0) : std::sin(angle);
  return {c * vector.x() - s * vector.y(), s * vector.x() + c * vector.y()};
}

}  // namespace datmo
