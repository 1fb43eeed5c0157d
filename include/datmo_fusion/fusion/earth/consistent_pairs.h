// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// The same point measured in two planes, one of which lies in the other at an unknown pose.
struct PointPair {
  Point2 a = Point2::Zero();  ///< m
  Point2 b = Point2::Zero();  ///< m
  double variance = 1.0;      ///< m^2, along each axis, of what remains between both
};

/// Which pairs fit together, and how well.
struct ConsistentPairs {
  std::vector<bool> fits;      ///< for each pair
  std::size_t count = 0;       ///< of those that fit
  double variance_factor = 0;  ///< 1; their residuals' weighted squares by degrees of freedom
};

/// Fits a rigid motion to the pairs by least squares, and leaves out those that contradict the
/// rest: as long as one of them adds more to the sum of squares than `gate`, the one that adds most
/// is left out (backward deletion; that sum without a pair is the squared Mahalanobis distance of
/// its deleted residual, so that a pair which bends the fit to itself is found, too). Chi-square
/// with two degrees of freedom, as the gate of a filter. Two pairs always fit.
ConsistentPairs consistentPairs(const std::vector<PointPair>& pairs, double gate);

}  // namespace datmo
