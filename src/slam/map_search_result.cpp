// SPDX-License-Identifier: BSD-3-Clause
// The resulting pose of MapSearch, and whether it is unique.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/LU>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/slam/map_search.h"
#include "datmo_fusion/slam/pose_covariance.h"

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

Eigen::Matrix3d ownCovariance(double sigma) {
  return Eigen::Vector3d(square(sigma), square(sigma), square(kFoundHeadingSigma)).asDiagonal();
}

}  // namespace

double MapSearch::distanceAt(const Pose2& pose) const {
  const std::vector<float> distances = distancesAt(pose);
  return std::accumulate(distances.begin(), distances.end(), 0.0);
}

const MapSearch::Box& MapSearch::nearestLeaf() const {
  const Box* nearest = &leaves_.front();
  double min_distance = distanceAt(poseOf(*nearest));
  for (const Box& leaf : leaves_) {
    const double distance = isSameHypothesis(leaf) ? distanceAt(poseOf(leaf)) : min_distance;
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

std::vector<double> MapSearch::leafProbabilities() const {
  std::vector<double> probabilities;
  for (const Box& leaf : leaves_) {
    probabilities.push_back(std::exp(leaves_.front().cost - leaf.cost));
  }
  const double sum = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
  for (double& probability : probabilities) {
    probability /= sum;
  }
  return probabilities;
}

Eigen::Matrix3d MapSearch::spreadAbout(const Pose2& pose) const {
  const std::vector<double> probabilities = leafProbabilities();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    const Eigen::Vector3d apart = differenceOf(pose, poseOf(leaves_[i]));
    spread += probabilities[i] * apart * apart.transpose();
  }
  return spread;
}

PoseWithCovariance MapSearch::found() const {
  const Pose2 pose = refined(poseOf(nearestLeaf()));
  const double sigma = options_.missing_share > 0.0 ? kFoundInCompleteSigma : kFoundSigma;
  return {pose, ownCovariance(sigma) + spreadAbout(pose)};
}

const MapSearch::Box& MapSearch::centralLeaf() const {
  const std::vector<double> probabilities = leafProbabilities();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  // from the best one
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    mean += probabilities[i] * between(leaves_.front(), leaves_[i]);
  }
  const auto distance = [&](const Box& leaf) {
    const Eigen::Vector3d apart = between(leaves_.front(), leaf) - mean;
    return std::hypot(apart.head<2>().norm(), options_.reach * apart[2]);
  };
  return *std::min_element(leaves_.begin(), leaves_.end(),
                           [&](const Box& a, const Box& b) { return distance(a) < distance(b); });
}

PoseWithCovariance MapSearch::centralPose() const {
  PoseWithCovariance central{refined(poseOf(centralLeaf())), {}};
  central.covariance = ownCovariance(kFoundSigma) + spreadAbout(central.pose);
  // The likelihoods are only bounds: the covariance has to reach all poses that are kept.
  const double kept_distance = std::sqrt(2.0 * options_.max_log_ratio);  // of a normal distribution
  const Eigen::Matrix3d information = central.covariance.inverse();
  double farthest = kept_distance;
  for (const Box& leaf : leaves_) {
    const Eigen::Vector3d apart = differenceOf(central.pose, poseOf(leaf));
    farthest = std::max(farthest, std::sqrt(apart.dot(information * apart)));
  }
  central.covariance *= square(farthest / std::max(kept_distance, 1.0));
  return central;
}

bool MapSearch::isNarrow(const Eigen::Matrix3d& covariance) const {
  const double reach = options_.reach;
  const std::array<Point2, 5> arms = {Point2(0.0, 0.0), Point2(reach, 0.0), Point2(-reach, 0.0),
                                      Point2(0.0, reach), Point2(0.0, -reach)};
  return std::all_of(arms.begin(), arms.end(), [&](const Point2& arm) {
    return maxPositionVariance(withLeverArm(covariance, arm)) <= square(options_.max_aligned_sigma);
  });
}

bool MapSearch::isInAlignedRegion(const Box& leaf) const {
  const Eigen::Vector3d apart = between(leaves_.front(), leaf);
  const double width = 2.0 * std::sqrt(2.0 * options_.max_log_ratio) * options_.max_aligned_sigma;
  return std::max(apart.head<2>().norm(), options_.reach * std::abs(apart[2])) <= width;
}

}  // namespace datmo
