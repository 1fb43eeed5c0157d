// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/grid/row_major.h"

namespace datmo {

/// Distances from the cells of a map to the nearest one of some kind (Felzenszwalb & Huttenlocher,
/// Distance transforms of sampled functions, 2012; by OpenCV). The map is not kept.
class DistanceField {
 public:
  /// `is_target`: whether distances lead to this cell of the map. `outside` (m): of what lies
  /// outside of the map's window.
  DistanceField(const OccupancyMap& map, const std::function<bool(CellIndex)>& is_target,
                double outside);

  /// m, between the centers of cells; `point` in the map frame, m.
  double at(const Point2& point) const {
    const CellIndex cell = window_.cellAt(point);
    return window_.contains(cell)
               ? static_cast<double>(
                     distances_[rowMajorIndex(cell.column - window_.corner.column,
                                              cell.row - window_.corner.row, window_.columns)])
               : outside_;
  }

  /// m, no more than from `point` to a target that lies in the map's window: outside of that, as
  /// far as it is to the window.
  double atLeast(const Point2& point) const {
    if (window_.contains(window_.cellAt(point))) {
      return at(point);
    }
    const Point2 end = window_.origin() + window_.cell_size * Point2(window_.columns, window_.rows);
    return (point - point.cwiseMax(window_.origin()).cwiseMin(end)).norm();
  }

 private:
  GridWindow window_;
  double outside_;
  std::vector<float> distances_;  ///< m, row by row
};

}  // namespace datmo
