// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

/// Calls `visit(CellIndex, Percent)` for each cell of a window whose center lies in a grid that is
/// seen from another frame, with the grid's value there: the nearest cell's value, row by
/// row. `grid_in_window`: pose of the grid's frame in the window's.
///
/// Each cell of the window is visited once at the most; a turned grid may have cells that no center
/// falls into.
template <typename Visit>
void resample(const SensorGrid& grid, const Pose2& grid_in_window, const GridWindow& window,
              Visit&& visit) {
  const GridWindow& source = grid.window();
  const Pose2 window_in_grid = grid_in_window.inverse();
  // PositionsTest are in cells from the grid's lower left corner.
  const Point2 step = window.cell_size / source.cell_size * window_in_grid.rotate(Point2::UnitX());
  const Point2 high(source.columns, source.rows);
  for (int row = window.corner.row; row < window.corner.row + window.rows; ++row) {
    const Point2 start =
        (window_in_grid * window.centerOf({window.corner.column, row}) - source.origin()) /
        source.cell_size;
    // Steps from the row's start after which it is inside of the grid, and is no more.
    double enter = 0.0;
    double leave = window.columns - 1;
    for (int axis = 0; axis < 2; ++axis) {
      if (step[axis] == 0.0) {
        leave = start[axis] < 0.0 || start[axis] > high[axis] ? -1.0 : leave;
        continue;
      }
      const double to_low = -start[axis] / step[axis];
      const double to_high = (high[axis] - start[axis]) / step[axis];
      enter = std::max(enter, std::min(to_low, to_high));
      leave = std::min(leave, std::max(to_low, to_high));
    }
    if (enter > leave) {
      continue;
    }
    const int last = static_cast<int>(std::floor(leave));
    for (int i = static_cast<int>(std::ceil(enter)); i <= last; ++i) {
      const Point2 position = start + i * step;
      // Not negative but by rounding, and so without a floor, which is slow.
      const CellIndex cell{source.corner.column + static_cast<int>(position.x()),
                           source.corner.row + static_cast<int>(position.y())};
      // By rounding the last place may lie just outside.
      if (source.contains(cell)) {
        visit(CellIndex{window.corner.column + i, row}, grid.at(cell));
      }
    }
  }
}

}  // namespace datmo
