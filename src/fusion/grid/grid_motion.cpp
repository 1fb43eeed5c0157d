// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/grid/grid_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "datmo_fusion/grid/grid_resampling.h"

namespace datmo {

namespace {

/// Moves occupied cells to the new position of their center: no other cell's center may lie in
/// them.
void pushOccupied(const SensorGrid& grid, const Pose2& old_base_in_new, SensorGrid& moved) {
  const GridWindow& window = grid.window();
  const Eigen::Matrix2d rotation = old_base_in_new.rotation();
  grid.forEach([&](CellIndex cell, Percent percent) {
    if (!isOccupied(percent)) {
      return;
    }
    const CellIndex position =
        window.cellAt(old_base_in_new.position() + rotation * window.centerOf(cell));
    if (window.contains(position)) {
      moved.at(position) = std::max(moved.at(position), percent);
    }
  });
}

/// For each row, where the disks around occupied cells begin (+1) and end (-1), with one column
/// more than the grid. Sums along a row count how many disks cover a cell, whatever their radius.
std::vector<int> diskEdges(const SensorGrid& grid, double radius) {
  const GridWindow& window = grid.window();
  const int columns = window.columns;
  const int reach = static_cast<int>(std::min<double>(radius, window.rows));
  std::vector<int> half_widths;  // by row from the disk's center
  for (int row = 0; row <= reach; ++row) {
    const double half = std::sqrt(radius * radius - static_cast<double>(row) * row);
    half_widths.push_back(static_cast<int>(std::min<double>(half, columns)));
  }
  std::vector<int> edges((static_cast<std::size_t>(columns) + 1) *
                         static_cast<std::size_t>(window.rows));
  grid.forEach([&](CellIndex cell, Percent percent) {
    if (!isOccupied(percent)) {
      return;
    }
    const int column = cell.column - window.corner.column;
    const int row = cell.row - window.corner.row;
    for (int y = std::max(0, row - reach); y <= std::min(window.rows - 1, row + reach); ++y) {
      const int half = half_widths[static_cast<std::size_t>(std::abs(y - row))];
      int* line = edges.data() + static_cast<std::ptrdiff_t>(y) * (columns + 1);
      ++line[std::max(0, column - half)];
      --line[std::min(columns, column + half + 1)];
    }
  });
  return edges;
}

/// `radius`: cells.
void forgetFreeAroundOccupied(SensorGrid& grid, double radius) {
  const std::vector<int> edges = diskEdges(grid, radius);
  const int columns = grid.window().columns;
  const int* edge = edges.data();
  Percent* cell = grid.cells().data();
  for (int row = 0; row < grid.window().rows; ++row, ++edge) {
    int disks = 0;
    for (int column = 0; column < columns; ++column, ++cell) {
      disks += *edge++;
      *cell = disks > 0 && isFree(*cell) ? kUnknownPercent : *cell;
    }
  }
}

}  // namespace

SensorGrid movedGrid(const SensorGrid& grid, Stamp stamp, const Pose2& old_base_in_new,
                     double mover_distance) {
  SensorGrid moved(stamp, grid.window());
  resample(grid, old_base_in_new, grid.window(),
           [&moved](CellIndex cell, Percent percent) { moved.at(cell) = percent; });
  pushOccupied(grid, old_base_in_new, moved);
  if (mover_distance >= grid.window().cell_size) {
    forgetFreeAroundOccupied(moved, mover_distance / grid.window().cell_size);
  }
  return moved;
}

}  // namespace datmo
