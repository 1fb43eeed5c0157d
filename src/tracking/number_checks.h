// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "datmo_fusion/common/pose2.h"

/// Requirements for the numbers of objects and tracks. NaN fails all of them, because it compares
/// false with everything.
namespace datmo {

/// Nothing on the ground is farther away or larger (m), faster (m/s) or older (s); squares of such
/// numbers stay far from the limits of a double.
inline constexpr double kMaxMagnitude = 1e9;

inline bool isModerate(double value) { return std::abs(value) <= kMaxMagnitude; }

inline bool isPosition(const Point2& point) {
  return isModerate(point.x()) && isModerate(point.y());
}

/// Finite and not negative.
inline bool isAmount(double value) { return std::isfinite(value) && value >= 0.0; }

inline bool isModerateAmount(double value) { return value >= 0.0 && value <= kMaxMagnitude; }

inline bool isShare(double value) { return value >= 0.0 && value <= 1.0; }

/// Finite, symmetric and positive definite.
template <int size>
bool isCovariance(const Eigen::Matrix<double, size, size>& matrix) {
  // A larger difference, relative to the variances, is not due to rounding.
  constexpr double kAsymmetry = 1e-6;
  const double difference = (matrix - matrix.transpose()).cwiseAbs().maxCoeff();
  return std::isfinite(matrix.sum()) && difference <= kAsymmetry * matrix.trace() &&
         matrix.llt().info() == Eigen::Success;
}

}  // namespace datmo
