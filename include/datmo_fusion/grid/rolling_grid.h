#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "datmo_fusion/grid/grid_window.h"

namespace datmo {

/// A window of cells that moves over the lattice with the vehicle. Cells that stay inside keep
/// their content and are not copied (a circular buffer in both directions); those that come in are
/// empty.
template <typename Cell>
class RollingGrid {
 public:
  /// A window of at least one cell.
  RollingGrid(const GridWindow& window, const Cell& empty)
      : window_(window),
        empty_(empty),
        cells_(static_cast<std::size_t>(window.columns) * static_cast<std::size_t>(window.rows),
               empty) {
    moveTo(window.corner);
  }

  /// `columns` and `rows` more than 0, `cell_size` (m) more than 0. The window's centre is the
  /// origin of the map frame.
  RollingGrid(int columns, int rows, double cell_size, const Cell& empty)
      : RollingGrid(GridWindow{cell_size, columns, rows, {-columns / 2, -rows / 2}}, empty) {}

  const GridWindow& window() const { return window_; }

  /// The cell must be inside of the window.
  const Cell& at(CellIndex cell) const { return cells_[slot(cell)]; }
  Cell& at(CellIndex cell) { return cells_[slot(cell)]; }

  /// What lies outside of the window is as empty as what was never touched.
  const Cell& atOrEmpty(CellIndex cell) const {
    return window_.contains(cell) ? cells_[slot(cell)] : empty_;
  }

  /// Moves the window so that `centre` (m, map frame) lies in its middle cell.
  void centreOn(const Point2& centre) {
    const CellIndex middle = window_.cellAt(centre);
    const CellIndex corner{middle.column - window_.columns / 2, middle.row - window_.rows / 2};
    const CellIndex old = window_.corner;
    moveTo(corner);
    for (int column = corner.column; column < corner.column + window_.columns; ++column) {
      const bool column_is_new = column < old.column || column >= old.column + window_.columns;
      if (column_is_new) {
        clear(column, corner.row, corner.row + window_.rows);
      } else {
        clear(column, corner.row, std::min(old.row, corner.row + window_.rows));
        clear(column, std::max(old.row + window_.rows, corner.row), corner.row + window_.rows);
      }
    }
  }

 private:
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
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(window_.columns) +
           static_cast<std::size_t>(column);
  }

  void moveTo(CellIndex corner) {
    window_.corner = corner;
    corner_slot_ = {modulo(corner.column, window_.columns), modulo(corner.row, window_.rows)};
  }

  void clear(int column, int first_row, int end_row) {
    for (int row = first_row; row < end_row; ++row) {
      at({column, row}) = empty_;
    }
  }

  GridWindow window_;
  CellIndex corner_slot_;  ///< where in `cells_` the window's corner is held
  Cell empty_;
  std::vector<Cell> cells_;
};

}  // namespace datmo
