// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "datmo_fusion/grid/grid_window.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"
#include "datmo_fusion/sensor_model/stereo_view.h"

namespace datmo {

/// The part of the ground that a stereo camera's grid covers.
struct ViewSector {
  double left_tangent = 0.0;  ///< right / forward
  double right_tangent = 0.0;
  double min_depth = 0.0;        ///< m, along the camera's heading
  double effective_range = 0.0;  ///< m, from the camera

  bool contains(const PointInView& position) const {
    return position.forward > min_depth && position.right >= left_tangent * position.forward &&
           position.right <= right_tangent * position.forward &&
           position.forward * position.forward + position.right * position.right <=
               effective_range * effective_range;
  }
};

/// Calls `visit(CellIndex, PointInView)` for each cell whose center is in view, row by row.
template <typename Visit>
void forEachCellInView(const GridWindow& window, const StereoView& view, const ViewSector& field,
                       Visit&& visit) {
  const Point2 reach(field.effective_range, field.effective_range);
  const CellIndex low = window.cellAt(view.position() - reach);
  const CellIndex high = window.cellAt(view.position() + reach);
  const CellIndex& corner = window.corner;
  const int end_row = std::min(high.row + 1, corner.row + window.rows);
  const int end_column = std::min(high.column + 1, corner.column + window.columns);
  for (int row = std::max(low.row, corner.row); row < end_row; ++row) {
    for (int column = std::max(low.column, corner.column); column < end_column; ++column) {
      const CellIndex cell{column, row};
      const PointInView position = view.viewedPoint(window.centerOf(cell));
      if (field.contains(position)) {
        visit(cell, position);
      }
    }
  }
}

}  // namespace datmo
