// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/odometry_anchor.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "datmo_fusion/slam/pose_covariance.h"

namespace datmo {

namespace {

/// s; minimum gap between two odometry poses: longer than the period of any odometry suited to a
/// scanner, so that the matches of a scan or two in between are kept.
constexpr double kGap = 0.25;

double squaredDistance(const PoseWithCovariance& a, const PoseWithCovariance& b) {
  const Eigen::Vector3d difference = differenceOf(a.pose, b.pose);
  const Eigen::Matrix3d covariance = a.covariance + b.covariance;
  return difference.dot(covariance.ldlt().solve(difference));
}

}  // namespace

void OdometryAnchor::keep(Stamp stamp, const PoseFilter& pose, const OdometryBuffer& odometry) {
  const std::optional<Stamp> last_pose = odometry.lastPose();
  if (!last_pose) {
    anchor_.reset();
    return;
  }
  if (!anchor_ || std::abs(secondsBetween(*last_pose, stamp)) <=
                      std::abs(secondsBetween(*last_pose, anchor_->stamp))) {
    anchor_.emplace(Anchor{stamp, *last_pose, pose});
  }
}

std::optional<PoseFilter> OdometryAnchor::correction(Stamp stamp, const PoseFilter& predicted,
                                                     const OdometryBuffer& odometry) const {
  const std::optional<Stamp> last_pose = odometry.lastPose();
  if (!anchor_ || !last_pose || secondsBetween(anchor_->last_pose, *last_pose) < kGap ||
      !odometry.hasPoses(anchor_->stamp, std::min(stamp, *last_pose))) {
    return std::nullopt;
  }
  PoseFilter by_odometry = anchor_->pose;
  const auto motion = odometry.motion(anchor_->stamp, stamp, by_odometry.errors());
  if (!motion) {
    return std::nullopt;
  }
  by_odometry.predictMeasured(*motion, secondsBetween(anchor_->stamp, stamp));
  if (squaredDistance(by_odometry.pose(), predicted.pose()) < kMaxSquaredPoseDistance) {
    return std::nullopt;
  }
  return by_odometry;
}

}  // namespace datmo
