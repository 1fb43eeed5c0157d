// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdlib>
#include <limits>

#include "datmo_fusion/grid/grid_window.h"

namespace datmo {

namespace detail {

/// One axis of a traversal: position along the line (0 to 1) of the next cell border, and the
/// spacing of further ones.
struct WalkAxis {
  int step = 0;
  double next_border = std::numeric_limits<double>::infinity();
  double per_cell = std::numeric_limits<double>::infinity();

  WalkAxis(double from, double delta, int cell, double cell_size) {
    if (delta == 0.0) {
      return;
    }
    step = delta > 0.0 ? 1 : -1;
    const double border = (cell + (step > 0 ? 1 : 0)) * cell_size;
    next_border = (border - from) / delta;
    per_cell = cell_size / std::abs(delta);
  }
};

}  // namespace detail

/// Calls `visit(CellIndex)` for every cell that the line from one point to another crosses, in
/// order and including both end cells (Amanatides & Woo, A fast voxel traversal algorithm for ray
/// tracing, 1987). Consecutive cells share a side. Cells outside the window are visited, too.
template <typename Visit>
void walkRay(const GridWindow& window, const Point2& from, const Point2& to, Visit&& visit) {
  CellIndex cell = window.cellAt(from);
  const CellIndex last = window.cellAt(to);
  detail::WalkAxis x(from.x(), to.x() - from.x(), cell.column, window.cell_size);
  detail::WalkAxis y(from.y(), to.y() - from.y(), cell.row, window.cell_size);
  // Counted rather than compared with the last cell, so that rounding at a border cannot overshoot.
  int steps = std::abs(last.column - cell.column) + std::abs(last.row - cell.row);
  visit(cell);
  for (; steps > 0; --steps) {
    const bool along_x =
        cell.row == last.row || (cell.column != last.column && x.next_border < y.next_border);
    if (along_x) {
      cell.column += x.step;
      x.next_border += x.per_cell;
    } else {
      cell.row += y.step;
      y.next_border += y.per_cell;
    }
    visit(cell);
  }
}

}  // namespace datmo
