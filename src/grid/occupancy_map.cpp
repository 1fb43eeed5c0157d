// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/occupancy_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/grid/beam_walk.h"
#include "datmo_fusion/grid/grid_resampling.h"
#include "datmo_fusion/grid/neighborhood.h"

namespace datmo {

namespace {

float logOdds(double probability) {
  return static_cast<float>(std::log(probability / (1.0 - probability)));
}

}  // namespace

OccupancyMap::OccupancyMap(const Checked<OccupancyMapOptions>& options)
    : options_(*options),
      hit_log_odds_(logOdds(options->hit_probability)),
      free_log_odds_(logOdds(options->free_probability)),
      log_odds_limit_(-logOdds(options->min_probability)),
      cells_(options->window.window(), Cell{}),
      outside_(options->max_tiles, Cell{}, options->tile_file) {}

std::vector<Point2> OccupancyMap::staticSurfaces() const {
  std::vector<Point2> surfaces;
  const CellIndex corner = window().corner;
  for (int row = corner.row; row < corner.row + window().rows; ++row) {
    for (int column = corner.column; column < corner.column + window().columns; ++column) {
      const Cell& cell = cells_.at({column, row});
      if (isStatic(cell)) {
        surfaces.push_back(window().centerOf({column, row}) + cell.hits.mean());
      }
    }
  }
  return surfaces;
}

template <typename Visit>
void OccupancyMap::forEachSurfaceAround(const Point2& point, Visit&& visit) const {
  forEachNeighbor(window().cellAt(point), [&](CellIndex index) {
    const Cell& cell = cells_.atOrEmpty(index);
    if (hasSurface(cell)) {
      visit(cell, index);
    }
  });
}

std::optional<HitDistribution> OccupancyMap::hitsAround(const Point2& point) const {
  HitSums sums;
  forEachSurfaceAround(point, [&](const Cell& cell, CellIndex index) {
    sums.add(cell.hits, window().centerOf(index) - point, maturity(cell), now_ - cell.mean_hit);
  });
  return sums.empty() ? std::nullopt : std::make_optional(sums.about(point));
}

std::optional<HitDistribution> OccupancyMap::nearestHits(const Point2& point) const {
  const Cell* nearest = nullptr;
  Point2 location;
  double min_distance = std::numeric_limits<double>::infinity();
  forEachSurfaceAround(point, [&](const Cell& cell, CellIndex index) {
    const Point2 center = window().centerOf(index);
    const double distance = (center + cell.hits.mean() - point).squaredNorm();
    if (distance < min_distance) {
      min_distance = distance;
      nearest = &cell;
      location = center;
    }
  });
  if (nearest == nullptr) {
    return std::nullopt;
  }
  HitSums sums;
  sums.add(nearest->hits, Point2::Zero(), maturity(*nearest), now_ - nearest->mean_hit);
  return sums.about(location);
}

void OccupancyMap::beginUpdate(Stamp stamp) {
  if (!first_stamp_) {
    first_stamp_ = stamp;
  }
  now_ = static_cast<float>(secondsBetween(*first_stamp_, stamp));
  ++update_;
}

void OccupancyMap::update(const Scan& scan, const std::vector<PointState>& states,
                          const Pose2& base_in_map) {
  beginUpdate(scan.stamp);
  for (std::size_t i = 0; i < scan.rays.size(); ++i) {
    if (scan.rays[i].hit && states[i] != PointState::kMoving) {
      hit(base_in_map * scan.rays[i].end);
    }
  }
  for (const Ray& ray : scan.rays) {
    passBeam(ray, base_in_map);
  }
}

void OccupancyMap::update(const GridUpdate& grid_update, const Pose2& base_in_map) {
  beginUpdate(grid_update.grid->stamp());
  for (const Point2& point : grid_update.surfaces) {
    hit(base_in_map * point);
  }
  for (const Point2& center : grid_update.cells) {
    occupy(window().cellAt(base_in_map * center));
  }
  const auto count = [&](const std::vector<Point2>& ends, int Cell::*counter) {
    for (const Point2& end : ends) {
      const CellIndex index = window().cellAt(base_in_map * end);
      if (window().contains(index)) {
        ++(cells_.at(index).*counter);
      }
    }
  };
  count(grid_update.surfaces, &Cell::believed);
  count(grid_update.movers, &Cell::believed);
  count(grid_update.refuted, &Cell::refuted);
  const Point2 from = base_in_map * grid_update.viewpoint;
  resample(*grid_update.grid, base_in_map, window(), [&](CellIndex cell, Percent percent) {
    if (isFree(percent)) {
      pass(cell, from, (window().centerOf(cell) - from).normalized());
    }
  });
}

void OccupancyMap::change(Cell& cell, float log_odds_step) const {
  const float log_odds =
      std::clamp(cell.log_odds + log_odds_step, -log_odds_limit_, log_odds_limit_);
  if (log_odds == cell.log_odds) {
    return;  // like most free cells, which are at the limit
  }
  cell.log_odds = log_odds;
  cell.occupancy = 1.0F / (1.0F + std::exp(-cell.log_odds));
}

OccupancyMap::Cell* OccupancyMap::occupy(CellIndex index) {
  if (!window().contains(index)) {
    return nullptr;
  }
  Cell& cell = cells_.at(index);
  if (!isOccupied(cell)) {
    cell.hits = {};
  }
  if (cell.updated != update_) {
    change(cell, hit_log_odds_);
    cell.updated = update_;
    cell.freed = 1.0F;  // no beam can free it in this scan
  }
  return &cell;
}

void OccupancyMap::hit(const Point2& point) {
  const CellIndex index = window().cellAt(point);
  if (Cell* cell = occupy(index)) {
    // Only cells with exact points get an age: a mover known to within several cells covers each of
    // them for longer than it takes to pass.
    if (cell->hits.count == 0.0F) {
      cell->first_hit = now_;
    }
    cell->last_hit = now_;
    cell->hits.add((point - window().centerOf(index)).cast<float>(), kMaxHits);
    cell->mean_hit += (now_ - cell->mean_hit) / cell->hits.count;
  }
}

float OccupancyMap::contradiction(const Cell& cell, CellIndex index, const Point2& from,
                                  const Point2& direction) const {
  if (options_.surface_sigma == 0.0 || !hasSurface(cell)) {
    return 1.0F;
  }
  HitSums sums;
  sums.add(cell.hits, Point2::Zero(), maturity(cell), now_ - cell.mean_hit);
  const HitDistribution surface = sums.about(window().centerOf(index));
  const Point2 across = perpendicular(direction);
  const double distance = across.dot(surface.mean - from);
  // By rounding, the spread of hits at one point may be negative.
  const double variance = std::max(0.0, across.dot(surface.covariance * across)) +
                          options_.surface_sigma * options_.surface_sigma;
  return static_cast<float>(std::exp(-0.5 * distance * distance / variance));
}

void OccupancyMap::pass(CellIndex index, const Point2& from, const Point2& direction) {
  if (!window().contains(index)) {
    return;
  }
  Cell& cell = cells_.at(index);
  if (cell.updated != update_) {
    cell.updated = update_;
    cell.freed = 0.0F;
  }
  if (cell.freed >= 1.0F) {
    return;
  }
  // Only the strongest contradiction among the scan's beams counts, whatever their order.
  const float freed = contradiction(cell, index, from, direction);
  if (freed > cell.freed) {
    change(cell, free_log_odds_ * (freed - cell.freed));
    cell.freed = freed;
  }
}

void OccupancyMap::passBeam(const Ray& ray, const Pose2& base_in_map) {
  const Point2 from = base_in_map * ray.origin;
  const Point2 to_end = base_in_map * ray.end - from;
  const CellIndex end = window().cellAt(from + to_end);
  const double free_range = ray.range - options_.beam_end.margin(ray);
  if (!(free_range > 0.0)) {
    return;
  }
  const Point2 along = free_range / ray.range * to_end;
  forEachLine(window(), {from, along, free_range, options_.beam_width}, [&](const Point2& to) {
    const CellIndex last = window().cellAt(to);
    const Point2 direction = (to - from).normalized();
    walkRay(window(), from, to, [&](CellIndex cell) {
      // The cell in which a beam ends is not free, even if it was not marked as hit.
      if (!ray.hit || (cell != end && cell != last)) {
        pass(cell, from, direction);
      }
    });
  });
}

std::vector<std::int8_t> OccupancyMap::occupancyImage() const {
  constexpr std::int8_t kNothingKnown = -1;
  std::vector<std::int8_t> image;
  image.reserve(rowMajorSize(window().columns, window().rows));
  const CellIndex corner = window().corner;
  for (int row = corner.row; row < corner.row + window().rows; ++row) {
    for (int column = corner.column; column < corner.column + window().columns; ++column) {
      const Cell& cell = cells_.at({column, row});
      image.push_back(!isKnown(cell)
                          ? kNothingKnown
                          : static_cast<std::int8_t>(std::lround(100.0F * cell.occupancy)));
    }
  }
  return image;
}

}  // namespace datmo
