// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Returns the difference (x, y, heading) of two poses along the axes of their common frame, to
/// which their covariances refer.
Eigen::Vector3d differenceOf(const Pose2& from, const Pose2& to);

/// Returns the covariance (x, y, heading) of a pose that is rigidly connected to one of this
/// covariance, at the offset `arm` (m).
Eigen::Matrix3d withLeverArm(const Eigen::Matrix3d& covariance, const Point2& arm);

/// Returns a covariance (x, y, heading) with its axes rotated by `angle` (rad).
Eigen::Matrix3d rotated(const Eigen::Matrix3d& covariance, double angle);

/// 99.9 % quantile of a chi-square distribution with three degrees of freedom: bound on the squared
/// Mahalanobis distance of two poses that agree.
inline constexpr double kMaxSquaredPoseDistance = 16.27;

/// Returns the variance of a position (x, y of a pose's covariance) in its least certain
/// direction, m^2.
double maxPositionVariance(const Eigen::Matrix3d& covariance);

}  // namespace datmo
