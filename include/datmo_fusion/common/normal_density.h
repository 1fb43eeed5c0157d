// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

/// Returns the density of a normal distribution at this distance from its mean. `variance`: above
/// 0.
inline double normalDensity(double distance, double variance) {
  return std::exp(-0.5 * square(distance) / variance) / std::sqrt(2.0 * kPi * variance);
}

}  // namespace datmo
