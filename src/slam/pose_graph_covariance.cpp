// SPDX-License-Identifier: BSD-3-Clause
// How certain the relative poses in a PoseGraph are.
#include <algorithm>
#include <limits>
#include <queue>

#include "datmo_fusion/slam/pose_covariance.h"
#include "datmo_fusion/slam/pose_graph.h"

namespace datmo {

namespace {

/// The pose at the end of a path, and the variance that the path adds to its position (m^2).
struct PathEnd {
  double variance;
  std::size_t pose;

  bool operator<(const PathEnd& other) const { return variance > other.variance; }
};

}  // namespace

std::vector<Eigen::Matrix3d> PoseGraph::covariancesUntil(std::size_t origin,
                                                         std::size_t pose) const {
  std::vector<std::vector<const PoseConstraint*>> at(poses_.size());
  for (const auto* constraints : {&motions_, &loops_}) {
    for (const PoseConstraint& constraint : *constraints) {
      at[constraint.from].push_back(&constraint);
      at[constraint.to].push_back(&constraint);
    }
  }
  std::vector<Eigen::Matrix3d> covariances(poses_.size(), Eigen::Matrix3d::Zero());
  std::vector<double> variances(poses_.size(), std::numeric_limits<double>::infinity());
  variances[pose] = 0.0;
  std::priority_queue<PathEnd> open;
  open.push({0.0, pose});
  while (!open.empty() && open.top().pose != origin) {
    const PathEnd end = open.top();
    open.pop();
    if (end.variance > variances[end.pose]) {
      continue;
    }
    for (const PoseConstraint* constraint : at[end.pose]) {
      // Its error rotates and moves all poses beyond it, in either direction about its later pose.
      const Eigen::Matrix3d more =
          withLeverArm(rotated(constraint->covariance, poses_[constraint->from].heading()),
                       poses_[pose].position() - poses_[constraint->to].position());
      const std::size_t next = constraint->from == end.pose ? constraint->to : constraint->from;
      const double variance = end.variance + more.topLeftCorner<2, 2>().trace();
      if (variance < variances[next]) {
        variances[next] = variance;
        covariances[next] = covariances[end.pose] + more;
        open.push({variance, next});
      }
    }
  }
  return covariances;
}

std::vector<Eigen::Matrix3d> PoseGraph::covariancesOf(std::size_t pose) const {
  return covariancesUntil(poses_.size(), pose);
}

Eigen::Matrix3d PoseGraph::covarianceBetween(std::size_t origin, std::size_t pose) const {
  return covariancesUntil(origin, pose)[origin];
}

}  // namespace datmo
