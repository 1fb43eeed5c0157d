// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "datmo_fusion/grid/grid_window.h"
#include "datmo_fusion/grid/row_major.h"

namespace datmo {

/// Distances from the cells of a window to the nearest target cell (Felzenszwalb & Huttenlocher,
/// Distance transforms of sampled functions, 2012; by OpenCV).
class DistanceField {
 public:
  /// `is_target`: whether a cell is a target. `outside` (m): distance returned outside the window.
  DistanceField(const GridWindow& window, const std::function<bool(CellIndex)>& is_target,
                double outside);

  /// Returns the distance between cell centers, m; `point` in the map frame, m.
  double at(const Point2& point) const {
    const CellIndex cell = window_.cellAt(point);
    return window_.contains(cell)
               ? static_cast<double>(
                     distances_[rowMajorIndex(cell.column - window_.corner.column,
                                              cell.row - window_.corner.row, window_.columns)])
               : outside_;
  }

 private:
  GridWindow window_;
  double outside_;
  std::vector<float> distances_;  ///< m, row by row
};

}  // namespace datmo
