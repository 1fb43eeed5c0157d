// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/map/map_changes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "datmo_fusion/grid/distance_field.h"
#include "datmo_fusion/slam/pose_covariance.h"

namespace datmo {

namespace {

/// Number of standard deviations that contains 95 percent of pose errors.
constexpr double kSigmas = 2.0;

DistanceField distanceToOccupied(const SensorGrid& grid) {
  return DistanceField(
      grid.window(), [&grid](CellIndex cell) { return isOccupied(grid.at(cell)); },
      std::numeric_limits<double>::infinity());
}

/// Apparent displacement of a point because of the pose's uncertainty, m.
class PoseReach {
 public:
  explicit PoseReach(const PoseWithCovariance& pose)
      : position_(pose.pose.position()),
        position_variance_(std::max(0.0, maxPositionVariance(pose.covariance))),
        heading_variance_(std::max(0.0, pose.covariance(2, 2))) {}

  double at(const Point2& point) const {
    const double squared_distance = (point - position_).squaredNorm();
    return kSigmas * std::sqrt(position_variance_ + squared_distance * heading_variance_);
  }

 private:
  Point2 position_;
  double position_variance_;  ///< m^2
  double heading_variance_;   ///< rad^2
};

}  // namespace

void MapChangeOptions::visit(OptionVisitor& visitor) {
  visitor.number({"sure", "1",
                  "probability above which a cell counts as occupied, and below 1 - it as free, to "
                  "have changed: more than a stereo camera alone can reach when discounted, since "
                  "its depth error shifts occupied cells into free space"},
                 sure, {0.51, 0.99});
  visitor.number({"same_within", "cells",
                  "an occupied cell has not changed if one is this close in the other map: the "
                  "next cell, including diagonally"},
                 same_within, {0.0, 100.0});
}

MapChanges changesBetween(const SensorGrid& before, const SensorGrid& now,
                          const PoseWithCovariance& base_in_map, const MapChangeOptions& options) {
  if (before.window() != now.window()) {
    throw std::invalid_argument("changesBetween: expected two maps of one window");
  }
  const GridWindow& window = now.window();
  const DistanceField to_old = distanceToOccupied(before);
  const DistanceField to_new = distanceToOccupied(now);
  const PoseReach reach(base_in_map);
  const Percent occupied = toPercent(options.sure);
  const auto is_free = [free = toPercent(1.0 - options.sure)](Percent percent) {
    return percent != kUnknownPercent && percent <= free;
  };
  MapChanges changes{SensorGrid(now.stamp(), window)};
  now.forEach([&](CellIndex cell, Percent seen) {
    const Percent known = before.at(cell);
    const bool is_new = seen >= occupied && is_free(known);
    const bool is_gone = known >= occupied && is_free(seen);
    if (!is_new && !is_gone) {
      return;
    }
    const Point2 center = window.centerOf(cell);
    const double same = options.same_within * window.cell_size + reach.at(center);
    if ((is_new ? to_old : to_new).at(center) <= same) {
      return;
    }
    changes.grid.at(cell) = is_new ? kNewPercent : kVanishedPercent;
    ++(is_new ? changes.appeared : changes.vanished);
  });
  return changes;
}

}  // namespace datmo
