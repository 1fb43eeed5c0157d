// SPDX-License-Identifier: BSD-3-Clause
// The resulting pose of MapSearch.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "datmo_fusion/slam/map_search.h"

namespace datmo {

namespace {

/// m, rad; standard deviations of the pose in the older map, in addition to the spread of the
/// hypotheses: the older map's own error, over the time of a gap or, in a complete map, between
/// neighboring walls.
constexpr double kFoundSigma = 0.3;
constexpr double kFoundInCompleteSigma = 0.1;
constexpr double kFoundHeadingSigma = degrees(1.0);

/// Steps (m, rad) of the refinement of a pose: from the distance of two leaves to well below what a
/// match corrects.
constexpr double kFirstStep = 0.08;
constexpr double kFirstTurn = degrees(0.5);
constexpr double kLastStep = 0.01;

}  // namespace

double MapSearch::distanceAt(const Pose2& pose) const {
  const std::vector<float> distances = distancesAt(pose);
  return std::accumulate(distances.begin(), distances.end(), 0.0);
}

const MapSearch::Box& MapSearch::nearestLeaf() const {
  const Box* nearest = &leaves_.front();
  double min_distance = distanceAt(poseOf(*nearest));
  for (const Box& leaf : leaves_) {
    const double distance = isTogether(leaf) ? distanceAt(poseOf(leaf)) : min_distance;
    if (distance < min_distance) {
      nearest = &leaf;
      min_distance = distance;
    }
  }
  return *nearest;
}

Pose2 MapSearch::refined(Pose2 pose) const {
  double min_distance = distanceAt(pose);
  for (double part = 1.0; part * kFirstStep >= kLastStep; part *= 0.5) {
    const double step = part * kFirstStep;
    const double turn = part * kFirstTurn;
    const std::array<Pose2, 6> steps = {Pose2(step, 0.0, 0.0), Pose2(-step, 0.0, 0.0),
                                        Pose2(0.0, step, 0.0), Pose2(0.0, -step, 0.0),
                                        Pose2(0.0, 0.0, turn), Pose2(0.0, 0.0, -turn)};
    for (bool nearer = true; nearer;) {
      nearer = false;
      for (const Pose2& by : steps) {
        const Pose2 moved = pose * by;
        const double distance = distanceAt(moved);
        if (distance < min_distance) {
          pose = moved;
          min_distance = distance;
          nearer = true;
        }
      }
    }
  }
  return pose;
}

std::optional<Pose2> MapSearch::likeliest() const {
  return leaves_.empty() ? std::nullopt : std::make_optional(refined(poseOf(nearestLeaf())));
}

PoseWithCovariance MapSearch::found() const {
  const Pose2 pose = refined(poseOf(nearestLeaf()));
  const double sigma = options_.missing_share > 0.0 ? kFoundInCompleteSigma : kFoundSigma;
  PoseWithCovariance found{pose, {}};
  found.covariance =
      Eigen::Vector3d(sigma * sigma, sigma * sigma, kFoundHeadingSigma * kFoundHeadingSigma)
          .asDiagonal();
  double sum = 0.0;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Box& leaf : leaves_) {
    const double weight = std::exp(leaves_.front().cost - leaf.cost);
    const Pose2 at = poseOf(leaf);
    const Eigen::Vector3d apart(at.x() - pose.x(), at.y() - pose.y(),
                                angleBetween(pose.heading(), at.heading()));
    spread += weight * apart * apart.transpose();
    sum += weight;
  }
  found.covariance += spread / sum;
  return found;
}

}  // namespace datmo
