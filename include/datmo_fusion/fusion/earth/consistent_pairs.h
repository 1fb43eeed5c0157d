// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// The same point measured in two planes whose relative pose is unknown.
struct PointPair {
  Point2 a = Point2::Zero();  ///< m
  Point2 b = Point2::Zero();  ///< m
  double variance = 1.0;      ///< m^2, along each axis, of the difference between both
};

/// Which pairs are consistent with each other, and how well.
struct ConsistentPairs {
  std::vector<bool> fits;      ///< per pair
  std::size_t count = 0;       ///< number of pairs that fit
  double variance_factor = 0;  ///< 1; weighted sum of squared residuals per degree of freedom
};

/// Fits a rigid motion to the pairs by least squares and rejects outliers by backward deletion: as
/// long as a pair adds more than `gate` to the sum of squares, the one that adds most is removed.
/// What a pair adds is the squared Mahalanobis distance of its deleted residual, so a pair that
/// bends the fit toward itself is found, too. `gate`: chi-square with two degrees of freedom, like
/// a filter's gate. Two pairs always fit.
ConsistentPairs consistentPairs(const std::vector<PointPair>& pairs, double gate);

}  // namespace datmo
