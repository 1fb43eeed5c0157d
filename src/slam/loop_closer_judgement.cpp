// SPDX-License-Identifier: BSD-3-Clause
// Which loops LoopCloser accepts.
#include <algorithm>

#include <Eigen/Cholesky>

#include "datmo_fusion/slam/loop_closer.h"
#include "datmo_fusion/slam/pose_covariance.h"

namespace datmo {

namespace {

/// A candidate is dropped if nothing has confirmed it after this many submap lengths.
constexpr double kCandidateLife = 5.0;

/// Candidates can confirm each other if they are this many submap lengths apart: no common scans.
constexpr double kApart = 1.0;

}  // namespace

bool LoopCloser::agree(const Candidate& a, const Candidate& b) const {
  const std::vector<Pose2>& poses = graph_.poses();
  const Pose2 a_global = poses[a.from] * a.motion;
  const Pose2 b_global = poses[b.from] * b.motion;
  const Pose2 expected = a_global * (poses[a.to].inverse() * poses[b.to]);
  const Eigen::Vector3d error(b_global.x() - expected.x(), b_global.y() - expected.y(),
                              angleBetween(expected.heading(), b_global.heading()));
  const double correction = angleBetween(poses[a.to].heading(), a_global.heading());
  const Eigen::Matrix3d covariance = rotated(graph_.covarianceBetween(a.to, b.to), correction) +
                                     withLeverArm(graph_.covarianceBetween(a.from, b.from),
                                                  b_global.position() - poses[b.from].position()) +
                                     withLeverArm(rotated(a.covariance, poses[a.from].heading()),
                                                  b_global.position() - a_global.position()) +
                                     rotated(b.covariance, poses[b.from].heading());
  return error.dot(covariance.llt().solve(error)) <= kMaxSquaredPoseDistance;
}

bool LoopCloser::judge(const Candidate& candidate, double prior_sigma) {
  if (prior_sigma <= options_.trusted_sigma) {
    graph_.close(candidate);
    return optimize();
  }
  const double at = nodes_[candidate.to].distance;
  const auto too_old =
      std::remove_if(candidates_.begin(), candidates_.end(), [&](const Candidate& each) {
        return at - nodes_[each.to].distance > kCandidateLife * options_.submap_length;
      });
  counts_.unconfirmed += static_cast<std::size_t>(candidates_.end() - too_old);
  candidates_.erase(too_old, candidates_.end());
  const auto confirmed =
      std::find_if(candidates_.begin(), candidates_.end(), [&](const Candidate& each) {
        return at - nodes_[each.to].distance >= kApart * options_.submap_length &&
               agree(each, candidate);
      });
  if (confirmed == candidates_.end()) {
    candidates_.push_back(candidate);
    return false;
  }
  graph_.close(*confirmed);
  graph_.close(candidate);
  counts_.unconfirmed += candidates_.size() - 1;
  candidates_.clear();
  return optimize();
}

bool LoopCloser::optimize() {
  if (!graph_.optimize()) {
    return false;
  }
  const std::size_t refuted = graph_.removeLoops(kMaxSquaredPoseDistance);
  counts_.refuted += refuted;
  if (refuted > 0) {
    graph_.optimize();
  }
  counts_.closed = graph_.loops().size();
  return true;
}

}  // namespace datmo
