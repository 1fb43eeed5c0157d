// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "datmo_fusion/common/angle.h"

/// Bounds that no measurement on the ground exceeds. A number beyond one is a fault of the sender;
/// within them, sums and squares stay far from the limits of a double, and a result fits into the
/// floats of messages.
namespace datmo {

inline constexpr double kMaxCoordinate = 2.0e7;  ///< m, half of the earth's circumference
inline constexpr double kMaxExtent = 1000.0;     ///< m, size of an object: longer than any train
/// m, of a scanner's beam: no vehicle's scanner reaches farther; drivers also use arbitrarily large
/// numbers for "no limit" and "no return".
inline constexpr double kMaxReach = 1000.0;
inline constexpr double kMaxRate = 1000.0;  ///< m/s, m/s^2, rad/s, of anything that is tracked
inline constexpr double kMaxBearing = 2.0 * kTurn;  ///< rad: drivers count from 0 or from -pi
inline constexpr double kMaxSweep = 10.0;           ///< s, from a scan's first beam to its last

/// Largest accepted asymmetry of a covariance in received and in published messages, relative to
/// the standard deviations of row and column, since its elements differ in unit and in size: it
/// covers the rounding of sums.
inline constexpr double kMaxAsymmetry = 1e-6;

/// Returns whether no element is larger in magnitude; false if one is NaN.
template <typename Matrix>
bool isWithin(const Eigen::MatrixBase<Matrix>& values, double bound) {
  return (values.array().abs() <= bound).all();
}

}  // namespace datmo
