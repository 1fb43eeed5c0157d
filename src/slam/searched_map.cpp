// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/searched_map.h"

#include <algorithm>
#include <limits>

namespace datmo {

namespace {

/// Occupancy of an unknown cell.
constexpr double kUnknownOccupancy = 0.5;

/// The part of a map's window that contains its free cells; at least one cell.
GridWindow freePart(const OccupancyMap& map) {
  const GridWindow& all = map.window();
  CellIndex first{all.corner.column + all.columns - 1, all.corner.row + all.rows - 1};
  CellIndex last = all.corner;
  for (int row = all.corner.row; row < all.corner.row + all.rows; ++row) {
    for (int column = all.corner.column; column < all.corner.column + all.columns; ++column) {
      if (map.stateOf({column, row}) == CellState::kFree) {
        first = {std::min(first.column, column), std::min(first.row, row)};
        last = {std::max(last.column, column), std::max(last.row, row)};
      }
    }
  }
  return {all.cell_size, std::max(1, last.column - first.column + 1),
          std::max(1, last.row - first.row + 1), first};
}

/// The window, extended by one cell on all sides.
GridWindow withMargin(GridWindow window) {
  window.corner = {window.corner.column - 1, window.corner.row - 1};
  window.columns += 2;
  window.rows += 2;
  return window;
}

}  // namespace

DistanceField freeSpaceOf(const OccupancyMap& map) {
  const auto is_free = [&map](CellIndex cell) { return map.stateOf(cell) == CellState::kFree; };
  return DistanceField(
      withMargin(freePart(map)),
      [&map, is_free](CellIndex cell) {
        if (is_free(cell)) {
          return false;
        }
        if (map.occupancy(cell) > kUnknownOccupancy) {
          return true;
        }
        const auto between = [&](int columns, int rows) {
          return is_free({cell.column + columns, cell.row + rows}) &&
                 is_free({cell.column - columns, cell.row - rows});
        };
        return !between(1, 0) && !between(0, 1) && !between(1, 1) && !between(1, -1);
      },
      0.0);
}

SearchedMap::SearchedMap(const OccupancyMap& map)
    : window_(map.window()),
      columns_(static_cast<float>(window_.columns)),
      rows_(static_cast<float>(window_.rows)),
      surfaces_(map.staticSurfaces()) {
  const DistanceField depths = freeSpaceOf(map);
  const DistanceField to_surfaces(
      window_, [&map](CellIndex cell) { return map.stateOf(cell) == CellState::kStatic; },
      std::numeric_limits<double>::infinity());
  cells_.reserve(rowMajorSize(window_.columns, window_.rows));
  for (int row = 0; row < window_.rows; ++row) {
    for (int column = 0; column < window_.columns; ++column) {
      const Point2 center =
          window_.centerOf({window_.corner.column + column, window_.corner.row + row});
      cells_.push_back({inSteps(depths.at(center) / window_.cell_size),
                        inSteps(to_surfaces.at(center) / window_.cell_size)});
    }
  }
}

std::uint16_t SearchedMap::inSteps(double cells) {
  constexpr double kMax = std::numeric_limits<std::uint16_t>::max();
  return static_cast<std::uint16_t>(std::min(kMax, cells * static_cast<double>(kSteps)));
}

float SearchedMap::toWindow(const Eigen::Vector2f& point) const {
  const Eigen::Vector2f nearest = point.cwiseMax(0.0F).cwiseMin(Eigen::Vector2f(columns_, rows_));
  return (point - nearest).norm();
}

}  // namespace datmo
