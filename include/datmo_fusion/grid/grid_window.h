// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/grid/cell_index.h"

namespace datmo {

/// The part of the lattice that a grid covers: `columns` x `rows` cells starting at `corner`.
///
///        y ^   rows
///          |  +--+--+--+
///          |  |  |  |  |      corner: the cell at the lower left,
///          |  +--+--+--+      with the least column and row
///          |  |XX|  |  |
///          |  +--+--+--+ columns
///          +----------------> x
struct GridWindow {
  double cell_size = 0.0;  ///< m
  int columns = 0;
  int rows = 0;
  CellIndex corner;

  /// Returns the cell that contains a point of the map frame; it may lie outside the window.
  /// Coordinates beyond kMaxCell cells, or NaN, are clamped to that limit.
  CellIndex cellAt(const Point2& point) const { return {indexAt(point.x()), indexAt(point.y())}; }

  /// Returns the center of a cell in the map frame, m.
  Point2 centerOf(CellIndex cell) const {
    return {(cell.column + 0.5) * cell_size, (cell.row + 0.5) * cell_size};
  }

  /// Returns the lower left corner of the window in the map frame, m.
  Point2 origin() const { return {corner.column * cell_size, corner.row * cell_size}; }

  bool contains(CellIndex cell) const {
    return cell.column >= corner.column && cell.column < corner.column + columns &&
           cell.row >= corner.row && cell.row < corner.row + rows;
  }

  /// Cells from the frame's origin: keeps sums and differences of two indices within an int.
  static constexpr int kMaxCell = 1 << 28;

 private:
  int indexAt(double coordinate) const {
    constexpr double kFarthest = kMaxCell;
    // In this order NaN becomes the lower limit.
    const double index = std::min(kFarthest, std::max(-kFarthest, coordinate / cell_size));
    const int whole = static_cast<int>(index);  // std::floor is a call on most processors
    return whole - (index < static_cast<double>(whole) ? 1 : 0);
  }
};

/// Calls `visit(CellIndex)` for the cells of a window that are outside another one of the same
/// size.
template <typename Visit>
void forEachCellOutside(const GridWindow& window, const GridWindow& other, Visit&& visit) {
  const auto visitRows = [&visit](int column, int first_row, int end_row) {
    for (int row = first_row; row < end_row; ++row) {
      visit(CellIndex{column, row});
    }
  };
  const CellIndex corner = window.corner;
  const CellIndex end{corner.column + window.columns, corner.row + window.rows};
  const CellIndex other_end{other.corner.column + other.columns, other.corner.row + other.rows};
  for (int column = corner.column; column < end.column; ++column) {
    if (column < other.corner.column || column >= other_end.column) {
      visitRows(column, corner.row, end.row);
    } else {
      visitRows(column, corner.row, std::min(other.corner.row, end.row));
      visitRows(column, std::max(other_end.row, corner.row), end.row);
    }
  }
}

}  // namespace datmo
