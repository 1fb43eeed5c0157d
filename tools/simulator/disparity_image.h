// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/grid/row_major.h"

namespace datmo::simulator {

/// No disparity: the sky, a hole, beyond the ranges.
inline constexpr double kNoDisparity = 0.0;

/// Disparities of the pixels of a left image that are looked at: each `column_step`-th column and
/// `row_step`-th row. In px of the full image; kNoDisparity where there is none.
struct DisparityImage {
  int columns = 0;  ///< looked at
  int rows = 0;
  int column_step = 1;
  int row_step = 1;
  std::vector<double> seen;      ///< true ones, row by row
  std::vector<double> measured;  ///< what the matching makes of them

  std::size_t slot(int column, int row) const { return rowMajorIndex(column, row, columns); }
};

}  // namespace datmo::simulator
