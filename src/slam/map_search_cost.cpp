// SPDX-License-Identifier: BSD-3-Clause
// What speaks against a hypothesis of MapSearch.
#include <algorithm>

#include "datmo_fusion/slam/map_search.h"

namespace datmo {

double MapSearch::priorCost(const Box& box) const {
  if (anywhere_) {
    return 0.0;
  }
  double reach = 0.0;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Eigen::Vector3d corner(x * box.half[0], y * box.half[1], box.half[2]);
      reach = std::max(reach, (whitening_ * corner).norm());
    }
  }
  const double distance = std::max(0.0, (whitening_ * box.offset).norm() - reach);
  return 0.5 * distance * distance;
}

double MapSearch::contradictedShare(const Box& box) const {
  const Pose2 pose = poseOf(box);
  const double moves = tolerance_ + box.half.head<2>().norm();
  const double turns = box.half[2];
  const Eigen::Matrix2d to_older = pose.rotation();
  int contradicted = 0;
  for (const Surface& surface : newer_.all) {
    const double depth = older_free_.at(pose.position() + to_older * surface.position);
    contradicted += depth > moves + turns * surface.distance ? 1 : 0;
  }
  // Of all the surfaces of a map only one pose tells which are near.
  const int seen_through = anywhere_ && !box.half.isZero() ? 0 : seenThrough(box);
  return (newer_.weight * contradicted + older_.weight * seen_through) /
         (newer_.weight * static_cast<double>(newer_.all.size()));
}

int MapSearch::seenThrough(const Box& box) const {
  const double moves = tolerance_ + box.half.head<2>().norm();
  const Pose2 to_newer = in_newer_ * poseOf(box).inverse();
  const Eigen::Matrix2d rotation = to_newer.rotation();
  const double shift = box.offset.head<2>().norm() + box.half.head<2>().norm();
  int seen_through = 0;
  for (const Surface& surface : older_.all) {
    const double depth = newer_free_.at(to_newer.position() + rotation * surface.position);
    seen_through += depth > moves + box.half[2] * (surface.distance + shift) ? 1 : 0;
  }
  return seen_through;
}

double MapSearch::missingShare(const Box& box) const {
  const Pose2 pose = poseOf(box);
  const Eigen::Matrix2d to_older = pose.rotation();
  const double moves = tolerance_ + box.half.head<2>().norm();
  int missing = 0;
  for (const Surface& surface : newer_.all) {
    const double distance = older_surface_.atLeast(pose.position() + to_older * surface.position);
    missing += distance > moves + box.half[2] * surface.distance ? 1 : 0;
  }
  return static_cast<double>(missing) / static_cast<double>(newer_.all.size());
}

double MapSearch::costOf(const Box& box) const {
  const double missing =
      options_.missing_share > 0.0 ? missingShare(box) / options_.missing_share : 0.0;
  return priorCost(box) + box.contradicted / options_.changed_share + missing;
}

double MapSearch::sharedAt(const Pose2& pose) const {
  const Eigen::Matrix2d rotation = pose.rotation();
  int shared = 0;
  for (const Surface& surface : newer_.all) {
    const double distance = older_surface_.at(pose.position() + rotation * surface.position);
    shared += distance <= tolerance_ ? 1 : 0;
  }
  return static_cast<double>(shared) / static_cast<double>(newer_.all.size());
}

}  // namespace datmo
