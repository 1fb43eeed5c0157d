// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_cones.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cell_objects.h"

#include "datmo_fusion/grid/neighborhood.h"
#include "datmo_fusion/grid/rolling_grid.h"

namespace datmo {

namespace {

/// The region that an object hides: bearings from the camera (rad, ascending to the right), and the
/// range (m) from which on.
struct Cone {
  double min_bearing = std::numeric_limits<double>::infinity();
  double max_bearing = -std::numeric_limits<double>::infinity();
  double range = std::numeric_limits<double>::infinity();
};

double bearingOf(const PointInView& position) {
  return std::atan2(position.right, position.forward);
}
double rangeOf(const PointInView& position) { return std::hypot(position.right, position.forward); }

/// Number of points of the layer in each cell (eq. 3.2.2): the thesis's grid of counts.
RollingGrid<int> countPoints(const StereoGridOptions& options, const StereoCloud& cloud,
                             const StereoView& view, const ViewSector& field,
                             const GridWindow& window, StereoCounts& counts) {
  RollingGrid<int> grid(window, 0);
  for (std::size_t i = 0; i < cloud.points.count; ++i) {
    const ViewedPoint point = view(cloud.points[i]);
    const PointInView position{point.forward, point.right};
    if (!(point.forward > 0.0F && std::isfinite(point.forward))) {
      continue;
    }
    ++counts.points;
    const double height = point.height - cloud.scanner_height;
    if (height > 0.0 && height < options.layer_thickness && field.contains(position)) {
      ++counts.in_layer;
      const CellIndex cell = window.cellAt(view.positionOf(position));
      if (window.contains(cell)) {
        ++grid.at(cell);
      }
    }
  }
  return grid;
}

/// Sum over a cell and its eight neighbors (eq. 3.2.3).
int sumAround(const RollingGrid<int>& counts, CellIndex cell) {
  int sum = 0;
  forEachNeighbor(cell, [&](CellIndex near) { sum += counts.atOrEmpty(near); });
  return sum;
}

Cone coneOf(const std::vector<CellIndex>& object, const GridWindow& window,
            const StereoView& view) {
  Cone cone;
  for (const CellIndex cell : object) {
    const PointInView position = view.viewedPoint(window.centerOf(cell));
    const double bearing = bearingOf(position);
    cone.min_bearing = std::min(cone.min_bearing, bearing);
    cone.max_bearing = std::max(cone.max_bearing, bearing);
    cone.range = std::min(cone.range, rangeOf(position));
  }
  return cone;
}

bool isHidden(const PointInView& position, const std::vector<Cone>& cones) {
  const double bearing = bearingOf(position);
  const double range = rangeOf(position);
  return std::any_of(cones.begin(), cones.end(), [&](const Cone& cone) {
    return bearing >= cone.min_bearing && bearing <= cone.max_bearing && range > cone.range;
  });
}

}  // namespace

StereoCounts fillByCones(const StereoGridOptions& options, const StereoCloud& cloud,
                         const StereoView& view, const ViewSector& field, SensorGrid& grid) {
  StereoCounts result;
  const GridWindow& window = grid.window();
  const RollingGrid<int> counts = countPoints(options, cloud, view, field, window, result);
  std::vector<CellIndex> occupied;
  forEachCellInView(window, view, field, [&](CellIndex cell, const PointInView& /*point*/) {
    if (sumAround(counts, cell) > options.cones.threshold) {
      grid.at(cell) = toPercent(options.occupied_probability);
      occupied.push_back(cell);
    }
  });
  std::vector<Cone> cones;
  for (const auto& object : objectsOf(occupied, window)) {
    cones.push_back(coneOf(object, window, view));
  }
  forEachCellInView(window, view, field, [&](CellIndex cell, const PointInView& position) {
    if (!isOccupied(grid.at(cell))) {
      grid.at(cell) =
          isHidden(position, cones) ? kUndecidedPercent : toPercent(options.free_probability);
    }
  });
  return result;
}

}  // namespace datmo
