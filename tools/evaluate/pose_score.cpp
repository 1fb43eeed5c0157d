// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/pose_score.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace datmo::evaluation {

namespace {

/// m: within a maneuver, and along a street; the errors of the former are the matcher's, those of
/// the latter the drift.
constexpr std::array<double, 2> kRelationDistances = {10.0, 70.0};

/// One estimated pose in the map of the truth, with the true one.
struct PosePair {
  Stamp stamp;
  Pose2 estimated;
  Pose2 truth;
  Eigen::Matrix3d covariance;  ///< x (m), y (m), heading (rad), map of the truth
  double path_length = 0.0;    ///< m, true, since the first pair

  Pose2 error() const { return truth.inverse() * estimated; }
};

using PosePairs = std::vector<PosePair>;

PosePairs pairsOf(const Trajectory& estimated, const Trajectory& truth, const Pose2& run_in_truth) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = run_in_truth.rotation();
  PosePairs pairs;
  for (const StampedPose& pose : estimated.poses()) {
    if (const auto true_pose = truth.at(pose.stamp)) {
      const double step =
          pairs.empty() ? 0.0 : (true_pose->position() - pairs.back().truth.position()).norm();
      pairs.push_back({pose.stamp, run_in_truth * pose.pose.pose, *true_pose,
                       turn * pose.pose.covariance * turn.transpose(),
                       step + (pairs.empty() ? 0.0 : pairs.back().path_length)});
    }
  }
  return pairs;
}

template <typename Value>
double rootMeanSquare(const PosePairs& pairs, const Value& value) {
  double sum = 0.0;
  for (const PosePair& pair : pairs) {
    sum += value(pair) * value(pair);
  }
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

/// The error of the estimated motion from one time to another.
Pose2 motionError(const PosePair& from, const PosePair& to) {
  const Pose2 true_motion = from.truth.inverse() * to.truth;
  return true_motion.inverse() * (from.estimated.inverse() * to.estimated);
}

double largestJump(const PosePairs& pairs) {
  double largest = 0.0;
  for (auto from = pairs.begin(); from != pairs.end(); ++from) {
    for (auto to = from; to != pairs.end() && secondsBetween(from->stamp, to->stamp) <= kJumpTime;
         ++to) {
      largest = std::max(largest, motionError(*from, *to).position().norm());
    }
  }
  return largest;
}

RelativePoseError relativeError(const PosePairs& pairs, double distance) {
  RelativePoseError result;
  result.distance = distance;
  double translation = 0.0;
  double rotation = 0.0;
  for (auto from = pairs.begin(); from != pairs.end(); ++from) {
    const auto to = std::lower_bound(
        from, pairs.end(), from->path_length + distance,
        [](const PosePair& pair, double path_length) { return pair.path_length < path_length; });
    if (to == pairs.end()) {
      break;
    }
    const Pose2 error = motionError(*from, *to);
    translation += error.position().norm();
    rotation += std::abs(error.heading());
    ++result.pairs;
  }
  if (result.pairs > 0) {
    result.translation = translation / static_cast<double>(result.pairs);
    result.rotation = rotation / static_cast<double>(result.pairs);
  }
  return result;
}

/// Excludes the pose at which run and truth are aligned if its covariance is zero: a run's map
/// begins there, so that it is known exactly, by definition.
Consistency consistencyOf(const PosePairs& pairs) {
  NeesSum sum(3);
  for (const PosePair& pair : pairs) {
    if (&pair == &pairs.front() && pair.covariance.isZero(0.0)) {
      continue;
    }
    const Point2 position = pair.estimated.position() - pair.truth.position();
    const Eigen::Vector3d error(position.x(), position.y(), pair.error().heading());
    sum.add(normalizedErrorSquared<3>(error, pair.covariance));
  }
  return sum.result();
}

}  // namespace

std::optional<PoseScore> scorePoses(const Trajectory& estimated, const Trajectory& truth) {
  const auto alignment = alignAtFirstPose(estimated, truth);
  if (!alignment) {
    return std::nullopt;
  }
  const PosePairs pairs = pairsOf(estimated, truth, alignment->run_in_truth);
  const PosePair& last = pairs.back();
  PoseScore score;
  score.end_error = last.error().position().norm();
  score.end_heading_error = std::abs(last.error().heading());
  score.path_length = last.path_length;
  if (score.path_length > 0.0) {
    score.end_share = score.end_error / score.path_length;
  }
  score.position_rmse =
      rootMeanSquare(pairs, [](const PosePair& pair) { return pair.error().position().norm(); });
  score.heading_rmse =
      rootMeanSquare(pairs, [](const PosePair& pair) { return pair.error().heading(); });
  score.largest_jump = largestJump(pairs);
  for (const double distance : kRelationDistances) {
    score.relative.push_back(relativeError(pairs, distance));
  }
  score.consistency = consistencyOf(pairs);
  return score;
}

}  // namespace datmo::evaluation
