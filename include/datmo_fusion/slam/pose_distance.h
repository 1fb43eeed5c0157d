// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Of squaredDistance() of two poses that are the same: chi-squared distribution, 3 degrees of
/// freedom, 0.999.
inline constexpr double kContradiction = 16.27;

/// Mahalanobis distance of two independent poses, squared; their covariances' sum is positive
/// definite.
inline double squaredDistance(const PoseWithCovariance& a, const PoseWithCovariance& b) {
  const Eigen::Vector3d difference(b.pose.x() - a.pose.x(), b.pose.y() - a.pose.y(),
                                   angleBetween(a.pose.heading(), b.pose.heading()));
  const Eigen::Matrix3d covariance = a.covariance + b.covariance;
  return difference.dot(covariance.ldlt().solve(difference));
}

}  // namespace datmo
