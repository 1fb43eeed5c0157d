// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/trajectory.h"

#include <algorithm>
#include <utility>

namespace datmo::evaluation {

Trajectory::Trajectory(std::vector<StampedPose> poses, double max_gap)
    : poses_(std::move(poses)), max_gap_(max_gap) {}

std::optional<Pose2> Trajectory::at(Stamp stamp) const {
  const auto found =
      std::lower_bound(poses_.begin(), poses_.end(), stamp,
                       [](const StampedPose& pose, Stamp s) { return pose.stamp < s; });
  if (found != poses_.end() && found->stamp == stamp) {
    return found->pose.pose;
  }
  if (poses_.size() < 2) {
    return std::nullopt;
  }
  const auto after = std::clamp(found, poses_.begin() + 1, poses_.end() - 1);
  const StampedPose& from = *(after - 1);
  const double step = secondsBetween(from.stamp, after->stamp);
  const double share = secondsBetween(from.stamp, stamp) / step;
  if (step > max_gap_ || share < -1.0 || share > 2.0) {
    return std::nullopt;
  }
  const Pose2 motion = from.pose.pose.inverse() * after->pose.pose;
  return from.pose.pose * Pose2(share * motion.position(), share * motion.heading());
}

std::optional<Alignment> alignAtFirstPose(const Trajectory& estimated, const Trajectory& truth) {
  for (const StampedPose& estimate : estimated.poses()) {
    if (const auto true_pose = truth.at(estimate.stamp)) {
      return Alignment{estimate.stamp, *true_pose * estimate.pose.pose.inverse()};
    }
  }
  return std::nullopt;
}

}  // namespace datmo::evaluation
