// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Covariance (x, y, heading) of a pose that is `arm` (m) away from one of this covariance, and
/// rigidly connected with it.
Eigen::Matrix3d carried(const Eigen::Matrix3d& covariance, const Point2& arm);

/// A covariance (x, y, heading) in axes from which its own are turned by this angle (rad).
Eigen::Matrix3d turned(const Eigen::Matrix3d& covariance, double angle);

/// Variance of a position (x, y, in a pose's covariance) in its least certain direction, m^2.
double maxPositionVariance(const Eigen::Matrix3d& covariance);

}  // namespace datmo
