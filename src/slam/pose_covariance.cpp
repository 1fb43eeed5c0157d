// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/pose_covariance.h"

#include <Eigen/Eigenvalues>

#include "datmo_fusion/common/angle.h"

namespace datmo {

Eigen::Vector3d differenceOf(const Pose2& from, const Pose2& to) {
  return {to.x() - from.x(), to.y() - from.y(), angleBetween(from.heading(), to.heading())};
}

Eigen::Matrix3d withLeverArm(const Eigen::Matrix3d& covariance, const Point2& arm) {
  Eigen::Matrix3d lever = Eigen::Matrix3d::Identity();
  lever(0, 2) = -arm.y();
  lever(1, 2) = arm.x();
  return lever * covariance * lever.transpose();
}

Eigen::Matrix3d rotated(const Eigen::Matrix3d& covariance, double angle) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  rotation.topLeftCorner<2, 2>() = Pose2(0.0, 0.0, angle).rotation();
  return rotation * covariance * rotation.transpose();
}

double maxPositionVariance(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
      Eigen::Matrix2d(covariance.topLeftCorner<2, 2>()), Eigen::EigenvaluesOnly);
  return axes.eigenvalues()[1];
}

}  // namespace datmo
