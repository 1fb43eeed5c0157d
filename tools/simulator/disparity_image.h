// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/grid/row_major.h"

namespace datmo::simulator {

/// No disparity: the sky, a hole, beyond the ranges.
inline constexpr double kNoDisparity = 0.0;

/// Disparities of the evaluated pixels of a left image: each `column_step`-th column and
/// `row_step`-th row. In px of the full image; kNoDisparity if there is none.
struct DisparityImage {
  int columns = 0;  ///< evaluated
  int rows = 0;
  int column_step = 1;
  int row_step = 1;
  std::vector<double> seen;      ///< true ones, row by row
  std::vector<double> measured;  ///< after simulated matching

  std::size_t slot(int column, int row) const { return rowMajorIndex(column, row, columns); }
};

}  // namespace datmo::simulator
