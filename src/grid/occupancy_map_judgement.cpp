// SPDX-License-Identifier: BSD-3-Clause
// The parts of OccupancyMap that classify cells, beam ends and beams.
#include <algorithm>

#include "datmo_fusion/grid/neighborhood.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/grid/ray_walk.h"

namespace datmo {

namespace {

/// A ghost is refuted by at least this share of all beams that ended there: with heavy traffic, a
/// few are refuted by mistake.
constexpr double kGhostShare = 0.1;

/// Minimum occupancy of a static cell, if it has been occupied long enough.
constexpr double kStaticAbove = 0.7;

/// In surface_sigma: closer than this to its end, a beam has not passed a surface, but hit it.
constexpr double kHitMargin = 3.0;

/// Minimum contradiction of a beam that passed through a surface rather than by its edge.
constexpr float kThrough = 0.5F;

}  // namespace

bool OccupancyMap::isStatic(const Cell& cell) const {
  return hasSurface(cell) && maturity(cell) >= 1.0 &&
         static_cast<double>(cell.occupancy) >= kStaticAbove;
}

bool OccupancyMap::isGhost(const Cell& cell) const {
  return options_.ghost_after > 0 && cell.refuted >= options_.ghost_after &&
         cell.refuted >= kGhostShare * (cell.refuted + cell.believed);
}

template <typename Test>
bool OccupancyMap::anyNear(CellIndex cell, Test&& test) const {
  return anyNeighbor(cell, options_.static_neighborhood,
                     [&](CellIndex near) { return test(cells_.atOrEmpty(near)); });
}

PointState OccupancyMap::judge(const Point2& point, const Point2& half_footprint) const {
  bool is_static = false;
  bool is_free = true;
  walkRay(window(), point - half_footprint, point + half_footprint, [&](CellIndex index) {
    is_static = is_static || anyNear(index, [this](const Cell& cell) { return isStatic(cell); });
    is_free = is_free && occupancy(index) < options_.moving_below;
  });
  if (is_static) {
    return PointState::kStatic;
  }
  const bool may_be_ghost = is_free && anyNear(window().cellAt(point),
                                               [this](const Cell& cell) { return isGhost(cell); });
  return is_free && !may_be_ghost ? PointState::kMoving : PointState::kUnknown;
}

bool OccupancyMap::seesThrough(const Ray& ray, const Pose2& base_in_map) const {
  const double margin =
      ray.hit ? std::max(options_.beam_end.margin(ray), kHitMargin * options_.surface_sigma) : 0.0;
  const double free_range = ray.range - margin;
  if (!(free_range > 0.0)) {
    return false;
  }
  const Point2 from = base_in_map * ray.origin;
  const Point2 along = free_range / ray.range * (base_in_map * ray.end - from);
  const Point2 direction = along.normalized();
  bool is_seen_through = false;
  walkRay(window(), from, from + along, [&](CellIndex index) {
    const Cell& cell = cells_.atOrEmpty(index);
    is_seen_through =
        is_seen_through ||
        (isStatic(cell) && contradiction(cell, index, from, direction) > kThrough &&
         direction.dot(window().centerOf(index) + cell.hits.mean() - from) < free_range);
  });
  return is_seen_through;
}

CellState OccupancyMap::stateOf(CellIndex index) const {
  const Cell& cell = cells_.atOrEmpty(index);
  if (isStatic(cell)) {
    return CellState::kStatic;
  }
  return cell.occupancy < options_.moving_below ? CellState::kFree : CellState::kUnknown;
}

}  // namespace datmo
