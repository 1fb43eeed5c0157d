// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/grid_masked_scan.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "datmo_fusion/grid/neighborhood.h"
#include "datmo_fusion/grid/ray_walk.h"

namespace datmo {

namespace {

/// The beam up to the end of the field, without a hit.
Ray rayOf(const Scan& scan, std::uint32_t beam) {
  Ray ray;
  ray.beam = beam;
  ray.bearing = normalizeAngle(scan.field.first_bearing + scan.field.beam_spacing * beam);
  ray.range = scan.field.range;
  ray.origin = scan.scanner_in_base.position();
  ray.end = scan.scanner_in_base *
            Point2(ray.range * std::cos(ray.bearing), ray.range * std::sin(ray.bearing));
  return ray;
}

std::vector<Ray> raysOfField(const Scan& scan) {
  std::vector<Ray> rays;
  rays.reserve(scan.field.beams);
  for (std::uint32_t beam = 0; beam < scan.field.beams; ++beam) {
    rays.push_back(rayOf(scan, beam));
  }
  return rays;
}

/// Ends the ray at the point nearest to the center of a cell.
void endAt(const Point2& center, Ray& ray) {
  const Point2 direction = (ray.end - ray.origin).normalized();
  ray.range = std::max(0.0, direction.dot(center - ray.origin));
  ray.end = ray.origin + ray.range * direction;
  ray.hit = true;
}

std::optional<CellIndex> firstOccupied(const SensorGrid& grid, const Ray& ray) {
  std::optional<CellIndex> first;
  walkRay(grid.window(), ray.origin, ray.end, [&](CellIndex cell) {
    if (!first && isOccupied(grid.atOrUnknown(cell))) {
      first = cell;
    }
  });
  return first;
}

/// Occupied cells that no beam accounts for.
class Unexplained {
 public:
  explicit Unexplained(const SensorGrid& grid) : rest_(grid) {}

  /// The hit of a beam may lie anywhere across its width, and in a neighboring cell.
  void explain(const Ray& ray, double beam_spacing) {
    const Point2 half_footprint = 0.5 * stepAcross(ray, beam_spacing);
    walkRay(rest_.window(), ray.end - half_footprint, ray.end + half_footprint,
            [&](CellIndex cell) { forEachNeighbor(cell, [&](CellIndex near) { forget(near); }); });
  }

  std::vector<Point2> centers() const {
    std::vector<Point2> centers;
    rest_.forEach([&](CellIndex cell, Percent percent) {
      if (isOccupied(percent)) {
        centers.push_back(rest_.window().centerOf(cell));
      }
    });
    return centers;
  }

 private:
  void forget(CellIndex cell) {
    if (rest_.window().contains(cell)) {
      rest_.at(cell) = kUnknownPercent;
    }
  }

  SensorGrid rest_;
};

}  // namespace

GridMaskedScan maskScanWithGrid(const SensorGrid& grid, const Scan& scan, GridEnds ends) {
  GridMaskedScan view;
  view.scan = scan;
  if (view.scan.rays.empty()) {
    view.scan.rays = raysOfField(scan);
  }
  Unexplained unexplained(grid);
  for (Ray& ray : view.scan.rays) {
    const CellIndex end = grid.window().cellAt(ray.end);
    // Outside the window nothing contradicts the scan.
    const bool confirmed = ray.hit && (!grid.window().contains(end) || isOccupied(grid.at(end)));
    if (ray.hit && !confirmed && isFree(grid.at(end))) {
      view.refuted.push_back(ray.end);
    }
    const bool measured = confirmed && ends == GridEnds::kScan;
    ray.hit = measured;
    if (!measured) {
      if (const auto cell = confirmed ? std::make_optional(end) : firstOccupied(grid, ray)) {
        endAt(grid.window().centerOf(*cell), ray);
      }
    }
    if (ray.hit) {
      unexplained.explain(ray, scan.field.beam_spacing);
    }
    view.measured.push_back(measured);
    view.any_measured = view.any_measured || measured;
  }
  view.cells = unexplained.centers();
  return view;
}

std::vector<Point2> excludeConnectedTo(const std::vector<Point2>& seeds, const SensorGrid& grid,
                                       const std::vector<Point2>& positions) {
  SensorGrid rest = grid;
  std::vector<CellIndex> open;
  const auto reach = [&](CellIndex cell) {
    if (isOccupied(rest.atOrUnknown(cell))) {
      rest.at(cell) = kUnknownPercent;
      open.push_back(cell);
    }
  };
  for (const Point2& seed : seeds) {
    reach(grid.window().cellAt(seed));
  }
  while (!open.empty()) {
    const CellIndex cell = open.back();
    open.pop_back();
    forEachNeighbor(cell, reach);
  }
  std::vector<Point2> apart;
  for (const Point2& position : positions) {
    if (isOccupied(rest.atOrUnknown(grid.window().cellAt(position)))) {
      apart.push_back(position);
    }
  }
  return apart;
}

SensorGrid withoutFreeEdges(const SensorGrid& grid) {
  SensorGrid result = grid;
  grid.forEach([&](CellIndex cell, Percent percent) {
    if (!isOccupied(percent)) {
      return;
    }
    forEachNeighbor(cell, [&](CellIndex near) {
      if (grid.window().contains(near) && isFree(grid.at(near))) {
        result.at(near) = kUnknownPercent;
      }
    });
  });
  return result;
}

}  // namespace datmo
