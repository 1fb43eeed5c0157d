// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace datmo {

/// Returns the number of cells of a table; neither argument below 0.
constexpr std::size_t rowMajorSize(int columns, int rows) {
  return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
}

/// Returns the index of a cell in a table of `columns` columns that is stored row by row; column
/// and row count from 0.
constexpr std::size_t rowMajorIndex(int column, int row, int columns) {
  return rowMajorSize(columns, row) + static_cast<std::size_t>(column);
}

}  // namespace datmo
