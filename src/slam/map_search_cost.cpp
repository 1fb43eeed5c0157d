// SPDX-License-Identifier: BSD-3-Clause
// The cost of MapSearch's hypotheses.
#include <algorithm>
#include <vector>

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

Eigen::Isometry2f MapSearch::patternAt(const Pose2& pose) const {
  const GridWindow& window = older_map_->window();
  const Point2 position = (pose.position() - window.origin()) / window.cell_size;
  Eigen::Isometry2f transform = Eigen::Isometry2f::Identity();
  transform.linear() = pose.rotation().cast<float>();
  transform.translation() = position.cast<float>();
  return transform;
}

MapSearch::Contradictions MapSearch::contradictionsOf(const Box& box) const {
  const Eigen::Isometry2f in_older = patternAt(poseOf(box));
  const double cell_size = older_map_->window().cell_size;
  const auto moves = static_cast<float>((tolerance_ + box.half.head<2>().norm()) / cell_size);
  const auto turns = static_cast<float>(box.half[2]);
  int in_free_space = 0;
  int missing = 0;
  for (const Pattern& surface : newer_) {
    const SearchedMap::Distances distances = older_map_->at(in_older * surface.position);
    const float moved = moves + turns * surface.distance;
    in_free_space += distances.depth > moved ? 1 : 0;
    missing += distances.to_surface > moved ? 1 : 0;
  }
  const auto all = static_cast<double>(newer_.size());
  return {in_free_space / all, missing / all};
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

void MapSearch::evaluate(Box& box) const {
  const Contradictions of_newer = contradictionsOf(box);
  // If the whole map is searched, only a single pose tells which of its surfaces are near.
  const int seen_through = anywhere_ && !box.half.isZero() ? 0 : seenThrough(box);
  box.contradicted =
      of_newer.in_free_space +
      older_.weight * seen_through / (newer_weight_ * static_cast<double>(newer_.size()));
  const double missing =
      options_.missing_share > 0.0 ? of_newer.missing / options_.missing_share : 0.0;
  box.cost = priorCost(box) + box.contradicted / options_.changed_share + missing;
}

std::vector<float> MapSearch::distancesAt(const Pose2& pose) const {
  const Eigen::Isometry2f in_older = patternAt(pose);
  const auto tolerance = static_cast<float>(tolerance_ / older_map_->window().cell_size);
  std::vector<float> distances;
  distances.reserve(newer_.size());
  for (const Pattern& surface : newer_) {
    const Eigen::Vector2f point = in_older * surface.position;
    distances.push_back(older_map_->contains(point)
                            ? std::min(tolerance, older_map_->at(point).to_surface)
                            : tolerance);
  }
  return distances;
}

double MapSearch::sharedAt(const Pose2& pose) const {
  const std::vector<float> distances = distancesAt(pose);
  const auto tolerance = static_cast<float>(tolerance_ / older_map_->window().cell_size);
  const auto shared = std::count_if(distances.begin(), distances.end(),
                                    [tolerance](float distance) { return distance < tolerance; });
  return static_cast<double>(shared) / static_cast<double>(newer_.size());
}

}  // namespace datmo
