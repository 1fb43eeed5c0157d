// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "datmo_fusion/grid/grid_window.h"
#include "datmo_fusion/grid/row_major.h"

namespace datmo {

/// A window of cells that moves over the lattice with the vehicle. Cells that stay inside keep
/// their content and are not copied (a circular buffer in both directions); cells that enter are
/// empty.
template <typename Cell>
class RollingGrid {
 public:
  /// A window of at least one cell.
  RollingGrid(const GridWindow& window, const Cell& empty)
      : window_(window), empty_(empty), cells_(rowMajorSize(window.columns, window.rows), empty) {
    moveTo(window.corner);
  }

  /// `columns`, `rows` and `cell_size` (m) must be more than 0. The window is centered on the
  /// origin of the map frame.
  RollingGrid(int columns, int rows, double cell_size, const Cell& empty)
      : RollingGrid(GridWindow{cell_size, columns, rows, {-columns / 2, -rows / 2}}, empty) {}

  const GridWindow& window() const { return window_; }

  /// The cell must be inside the window.
  const Cell& at(CellIndex cell) const { return cells_[slot(cell)]; }
  Cell& at(CellIndex cell) { return cells_[slot(cell)]; }

  /// Returns the cell, or an empty one outside the window.
  const Cell& atOrEmpty(CellIndex cell) const {
    // As unsigned numbers, indices before the corner are beyond the end.
    const bool inside =
        static_cast<unsigned>(cell.column - window_.corner.column) <
            static_cast<unsigned>(window_.columns) &&
        static_cast<unsigned>(cell.row - window_.corner.row) < static_cast<unsigned>(window_.rows);
    return inside ? cells_[slot(cell)] : empty_;
  }

  /// Returns the indices for atIndex() of many cells: faster than atOrEmpty() for each, because its
  /// only loop is vectorizable.
  template <std::size_t kCount>
  std::array<unsigned, kCount> indicesOf(const std::array<int, kCount>& columns,
                                         const std::array<int, kCount>& rows) const {
    const auto first_column = static_cast<unsigned>(window_.corner.column);
    const auto first_row = static_cast<unsigned>(window_.corner.row);
    const auto all_columns = static_cast<unsigned>(window_.columns);
    const auto all_rows = static_cast<unsigned>(window_.rows);
    const auto column_of_corner = static_cast<unsigned>(corner_slot_.column);
    const auto row_of_corner = static_cast<unsigned>(corner_slot_.row);
    std::array<unsigned, kCount> indices;
    for (std::size_t i = 0; i < kCount; ++i) {
      const unsigned column = static_cast<unsigned>(columns[i]) - first_column;
      const unsigned row = static_cast<unsigned>(rows[i]) - first_row;
      const unsigned next_column = column + column_of_corner;
      const unsigned next_row = row + row_of_corner;
      const unsigned index = (next_row < all_rows ? next_row : next_row - all_rows) * all_columns +
                             (next_column < all_columns ? next_column : next_column - all_columns);
      const bool inside = (column < all_columns) & (row < all_rows);  // no &&: no branch
      indices[i] = inside ? index : kOutside;
    }
    return indices;
  }

  /// Returns the cell, or an empty one outside the window.
  const Cell& atIndex(unsigned index) const { return index == kOutside ? empty_ : cells_[index]; }

  /// Returns the window as centerOn would move it.
  GridWindow windowOn(const Point2& center) const {
    GridWindow window = window_;
    const CellIndex middle = window_.cellAt(center);
    window.corner = {middle.column - window_.columns / 2, middle.row - window_.rows / 2};
    return window;
  }

  /// Moves the window so that `center` (m, map frame) lies in its middle cell.
  void centerOn(const Point2& center) {
    const GridWindow old = window_;
    moveTo(windowOn(center).corner);
    forEachCellOutside(window_, old, [this](CellIndex cell) { at(cell) = empty_; });
  }

  /// The same, but first calls `leave(CellIndex)` for each cell that will be outside.
  template <typename Leave>
  void centerOn(const Point2& center, Leave&& leave) {
    forEachCellOutside(window_, windowOn(center), leave);
    centerOn(center);
  }

 private:
  static constexpr unsigned kOutside = std::numeric_limits<unsigned>::max();

  static int modulo(int value, int size) {
    const int rest = value % size;
    return rest < 0 ? rest + size : rest;
  }

  /// `index` lies in the window, so that one subtraction replaces the division of a modulo.
  static int wrap(int index, int corner, int corner_slot, int size) {
    const int slot = index - corner + corner_slot;
    return slot < size ? slot : slot - size;
  }

  std::size_t slot(CellIndex cell) const {
    const int column =
        wrap(cell.column, window_.corner.column, corner_slot_.column, window_.columns);
    const int row = wrap(cell.row, window_.corner.row, corner_slot_.row, window_.rows);
    return rowMajorIndex(column, row, window_.columns);
  }

  void moveTo(CellIndex corner) {
    window_.corner = corner;
    corner_slot_ = {modulo(corner.column, window_.columns), modulo(corner.row, window_.rows)};
  }

  GridWindow window_;
  CellIndex corner_slot_;  ///< position of the window's corner in `cells_`
  Cell empty_;
  std::vector<Cell> cells_;
};

}  // namespace datmo
