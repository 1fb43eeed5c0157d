// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/grid/grid_window.h"
#include "datmo_fusion/grid/row_major.h"

namespace datmo {

/// Knowledge about one cell: its probability of being occupied in percent, 0 to 100, or
/// kUnknownPercent (nav_msgs/OccupancyGrid).
using Percent = std::int8_t;
inline constexpr Percent kUnknownPercent = -1;

/// As likely occupied as free: a sensor observed the cell, but without a clear result.
inline constexpr Percent kUndecidedPercent = 50;

inline bool isOccupied(Percent percent) { return percent > kUndecidedPercent; }
inline bool isFree(Percent percent) { return percent >= 0 && percent < kUndecidedPercent; }

/// `probability`: 0 to 1.
inline Percent toPercent(double probability) {
  return static_cast<Percent>(std::lround(100.0 * probability));
}

/// The measurement of one sensor, or of several fused, at one time around the vehicle: an
/// instantaneous occupancy grid (thesis 3.2). Its frame is the vehicle's (base_link) at its stamp;
/// the window is fixed in that frame, so that grids of the same window differ only in content.
class SensorGrid {
 public:
  SensorGrid() = default;
  /// All cells unknown.
  SensorGrid(Stamp stamp, const GridWindow& window)
      : stamp_(stamp),
        window_(window),
        cells_(rowMajorSize(window.columns, window.rows), kUnknownPercent) {}

  Stamp stamp() const { return stamp_; }
  const GridWindow& window() const { return window_; }

  /// The cell must be inside the window.
  Percent at(CellIndex cell) const { return cells_[slot(cell)]; }
  Percent& at(CellIndex cell) { return cells_[slot(cell)]; }

  /// Returns the cell's value; unknown outside the window.
  Percent atOrUnknown(CellIndex cell) const {
    return window_.contains(cell) ? at(cell) : kUnknownPercent;
  }

  /// Row by row from the lower left corner.
  const std::vector<Percent>& cells() const { return cells_; }
  std::vector<Percent>& cells() { return cells_; }

  /// Calls `visit(CellIndex, Percent)` for each cell, in the order of cells().
  template <typename Visit>
  void forEach(Visit&& visit) const {
    std::size_t slot = 0;
    for (int row = window_.corner.row; row < window_.corner.row + window_.rows; ++row) {
      for (int column = window_.corner.column; column < window_.corner.column + window_.columns;
           ++column) {
        visit(CellIndex{column, row}, cells_[slot++]);
      }
    }
  }

 private:
  std::size_t slot(CellIndex cell) const {
    return rowMajorIndex(cell.column - window_.corner.column, cell.row - window_.corner.row,
                         window_.columns);
  }

  Stamp stamp_;
  GridWindow window_;
  std::vector<Percent> cells_;
};

/// Whether two windows cover the same cells, so that their grids can be compared cell by cell.
inline bool operator==(const GridWindow& a, const GridWindow& b) {
  return a.cell_size == b.cell_size && a.columns == b.columns && a.rows == b.rows &&
         a.corner == b.corner;
}
inline bool operator!=(const GridWindow& a, const GridWindow& b) { return !(a == b); }

}  // namespace datmo
