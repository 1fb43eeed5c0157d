// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

/// Calls `visit(CellIndex, Percent)`, row by row, for each cell of a window whose center lies in a
/// grid given in another frame, with the value of the nearest grid cell. `grid_in_window`: pose of
/// the grid's frame in the window's.
///
/// Each cell of the window is visited at most once; a rotated grid may have cells that contain no
/// center.
template <typename Visit>
void resample(const SensorGrid& grid, const Pose2& grid_in_window, const GridWindow& window,
              Visit&& visit) {
  const GridWindow& source = grid.window();
  const Pose2 window_in_grid = grid_in_window.inverse();
  // Positions are in cells from the grid's lower left corner.
  const Point2 step = window.cell_size / source.cell_size * window_in_grid.rotate(Point2::UnitX());
  const Point2 high(source.columns, source.rows);
  for (int row = window.corner.row; row < window.corner.row + window.rows; ++row) {
    const Point2 start =
        (window_in_grid * window.centerOf({window.corner.column, row}) - source.origin()) /
        source.cell_size;
    // Steps from the row's start at which it enters and leaves the grid.
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
      // Never negative except by rounding, so a slow std::floor is not needed.
      const CellIndex cell{source.corner.column + static_cast<int>(position.x()),
                           source.corner.row + static_cast<int>(position.y())};
      // By rounding, the last position may lie just outside.
      if (source.contains(cell)) {
        visit(CellIndex{window.corner.column + i, row}, grid.at(cell));
      }
    }
  }
}

}  // namespace datmo
