// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "datmo_fusion/common/covariance_check.h"
#include "datmo_fusion/common/physical_bounds.h"
#include "datmo_fusion/common/pose2.h"

/// Requirements for the numbers of objects and tracks. NaN fails all of them, because it compares
/// false with everything.
namespace datmo {

/// An age (s) fits into a message's duration; a variance this large (rad^2) means unknown; nothing
/// is seen as far (m); and sums of them stay far from the limits of a double.
inline constexpr double kMaxAmount = 1e9;

inline bool isPosition(const Point2& point) { return isWithin(point, kMaxCoordinate); }

inline bool isExtent(double value) { return value >= 0.0 && value <= kMaxExtent; }

inline bool isRate(double value) { return std::abs(value) <= kMaxRate; }

inline bool isAmount(double value) { return value >= 0.0 && value <= kMaxAmount; }

inline bool isShare(double value) { return value >= 0.0 && value <= 1.0; }

/// Rounding error of a sum of probabilities, which messages have as floats.
inline constexpr double kShareRounding = 1e-3;

/// Probabilities of exclusive alternatives; all are 0 if nothing is known.
template <std::size_t count>
bool areShares(const std::array<double, count>& values) {
  return std::all_of(values.begin(), values.end(), isShare) &&
         std::accumulate(values.begin(), values.end(), 0.0) <= 1.0 + kShareRounding;
}

}  // namespace datmo
