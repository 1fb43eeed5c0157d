// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/loop_closer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Eigenvalues>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/slam/pose_covariance.h"

namespace datmo {

namespace {

/// m; drift between keyframes is that of at least this distance: a turn in place is not exact,
/// either.
constexpr double kMinMotion = 0.2;

/// m per rad; an old keyframe passed in another direction is ranked as if it were this much farther
/// away for each rad of difference.
constexpr double kDistancePerTurn = 5.0;

/// Standard deviations of the drift within which old keyframes are considered.
constexpr double kDriftReach = 3.0;

/// A pose this close to the previous one (m, rad) and this soon after it (s) is left out of the
/// trajectory.
constexpr double kRestPosition = 0.005;
constexpr double kRestHeading = degrees(0.05);
constexpr double kRestPeriod = 0.5;

bool isAtRest(const StampedPose& before, const StampedPose& now) {
  return (now.pose.position() - before.pose.position()).norm() < kRestPosition &&
         std::abs(angleBetween(before.pose.heading(), now.pose.heading())) < kRestHeading &&
         secondsBetween(before.stamp, now.stamp) < kRestPeriod;
}

/// m; maximum by which the old submap is extended on either side for drift.
constexpr double kMaxHalf = 60.0;

/// The covariance `later` minus what was known before, as far as that is a covariance.
Eigen::Matrix3d growth(const Eigen::Matrix3d& before, const Eigen::Matrix3d& later) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(later - before);
  return axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).asDiagonal() *
         axes.eigenvectors().transpose();
}

double largestSigma(const Eigen::Matrix3d& covariance) {
  return std::sqrt(maxPositionVariance(covariance));
}

}  // namespace

LoopCloser::LoopCloser(const Checked<LoopCloserOptions>& options)
    : options_(*options), matcher_(options->submaps), graph_(options->graph) {
  if (options_.min_loop < options_.submap_length) {
    throw OptionError("min_loop = " + toText(options_.min_loop) +
                      ": expected at least submap_length, " + toText(options_.submap_length));
  }
}

void LoopCloser::clear() {
  graph_.clear();
  nodes_.clear();
  candidates_.clear();
  counts_ = {};
  searched_ = 0.0;
  scans_ = 0;
  stride_ = 1;
}

Eigen::Matrix3d LoopCloser::driftOf(const Keyframe& from, const Keyframe& to,
                                    double distance) const {
  const PoseWithCovariance& begin = from.base_in_map;
  const PoseWithCovariance& end = to.base_in_map;
  const Point2 arm = end.pose.position() - begin.pose.position();
  const Eigen::Matrix3d claimed = growth(withLeverArm(begin.covariance, arm), end.covariance);
  const double length = std::max(distance, kMinMotion);
  const Eigen::Vector3d least(square(options_.position_drift) * length,
                              square(options_.position_drift) * length,
                              square(options_.heading_drift) * length);
  return rotated(claimed, -begin.pose.heading()) + Eigen::Matrix3d(least.asDiagonal());
}

void LoopCloser::append(Keyframe keyframe) {
  Node node;
  if (nodes_.empty()) {
    graph_.start(keyframe.base_in_map.pose);
  } else {
    const Node& last = nodes_.back();
    const Pose2 motion = last.keyframe.base_in_map.pose.inverse() * keyframe.base_in_map.pose;
    const double distance = motion.position().norm();
    graph_.extend(motion, driftOf(last.keyframe, keyframe, distance));
    node.distance = last.distance + distance;
  }
  node.keyframe = std::move(keyframe);
  if (nodes_.size() % stride_ == 0) {
    ++scans_;
  } else {
    node.keyframe.scan = {};
  }
  nodes_.push_back(std::move(node));
}

void LoopCloser::thinOut() {
  stride_ *= 2;
  scans_ = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (i % stride_ == 0) {
      ++scans_;
    } else {
      nodes_[i].keyframe.scan = {};
    }
  }
}

bool LoopCloser::add(Keyframe keyframe) {
  append(std::move(keyframe));
  if (scans_ > static_cast<std::size_t>(options_.max_scans)) {
    thinOut();
  }
  if (length() - searched_ < options_.search_distance) {
    return false;
  }
  searched_ = length();
  return search();
}

void LoopCloser::addPose(const StampedPose& base_in_map) {
  if (nodes_.empty()) {
    return;
  }
  Node& last = nodes_.back();
  const StampedPose now{base_in_map.stamp,
                        last.keyframe.base_in_map.pose.inverse() * base_in_map.pose};
  const StampedPose before =
      last.followers.empty() ? StampedPose{last.keyframe.stamp, {}} : last.followers.back();
  if (!isAtRest(before, now)) {
    last.followers.push_back(now);
  }
}

std::optional<std::size_t> LoopCloser::middleOfLast() const {
  const double middle = length() - 0.5 * options_.submap_length;
  const auto node = std::find_if(nodes_.begin(), nodes_.end(),
                                 [middle](const Node& each) { return each.distance >= middle; });
  return middle > 0.0 ? std::make_optional(static_cast<std::size_t>(node - nodes_.begin()))
                      : std::nullopt;
}

std::optional<std::size_t> LoopCloser::oldNear(std::size_t node,
                                               const std::vector<Eigen::Matrix3d>& drift) const {
  const std::vector<Pose2>& poses = graph_.poses();
  std::optional<std::size_t> nearest;
  double min_cost = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < node; ++i) {
    if (nodes_[node].distance - nodes_[i].distance < options_.min_loop) {
      break;
    }
    const double distance = (poses[i].position() - poses[node].position()).norm();
    const double turn = std::abs(angleBetween(poses[i].heading(), poses[node].heading()));
    const double cost = distance + kDistancePerTurn * turn;
    if (cost >= min_cost) {
      continue;
    }
    const double sigma = largestSigma(drift[i]);
    if (sigma <= options_.max_sigma && distance <= options_.max_distance + kDriftReach * sigma) {
      nearest = i;
      min_cost = cost;
    }
  }
  return nearest;
}

Submap LoopCloser::submap(double from, double to, std::size_t frame) const {
  const Pose2 to_frame = graph_.poses()[frame].inverse();
  Submap submap;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.distance >= from && node.distance <= to && !node.keyframe.scan.empty()) {
      submap.add(node.keyframe.scan.scan(node.keyframe.stamp), to_frame * graph_.poses()[i]);
    }
  }
  return submap;
}

bool LoopCloser::search() {
  const std::optional<std::size_t> newer = middleOfLast();
  if (!newer) {
    return false;
  }
  const std::vector<Eigen::Matrix3d> drift = graph_.covariancesOf(*newer);
  const auto old = oldNear(*newer, drift);
  if (!old) {
    return false;
  }
  const Pose2& old_pose = graph_.poses()[*old];
  const double sigma = largestSigma(drift[*old]);
  const double half = 0.5 * options_.submap_length;
  const double old_half = half + std::min(kDriftReach * sigma, kMaxHalf);
  const double at = nodes_[*old].distance;
  const double newest_old = nodes_[*newer].distance - options_.min_loop;
  const SubmapMatcher::Result result = matcher_.match(
      submap(at - old_half, std::min(at + old_half, newest_old), *old),
      submap(nodes_[*newer].distance - half, length(), *newer),
      {old_pose.inverse() * graph_.poses()[*newer], rotated(drift[*old], -old_pose.heading())});
  switch (result.outcome) {
    case SubmapMatcher::Outcome::kFound:
      return judge({*old, *newer, result.newer_in_older.pose, result.newer_in_older.covariance},
                   sigma);
    case SubmapMatcher::Outcome::kAmbiguous:
      ++counts_.ambiguous;
      return false;
    case SubmapMatcher::Outcome::kNone:
    case SubmapMatcher::Outcome::kNoMatch:
      ++counts_.unlike;
      return false;
  }
  return false;
}

}  // namespace datmo
