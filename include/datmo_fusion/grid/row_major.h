// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace datmo {

/// How many cells a table has; neither number below 0.
constexpr std::size_t rowMajorSize(int columns, int rows) {
  return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
}

/// Where a table of `columns` columns that is stored row by row has its cell of this column and
/// row; all of them from 0 on.
constexpr std::size_t rowMajorIndex(int column, int row, int columns) {
  return rowMajorSize(columns, row) + static_cast<std::size_t>(column);
}

}  // namespace datmo
