// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/grid/row_major.h"

namespace datmo {

/// A table of counts with the sum over any rectangle in four look-ups: a summed-area table (Crow,
/// Summed-area tables for texture mapping, 1984).
class SummedCounts {
 public:
  /// Sets all counts to 0, not yet summed. Keeps its memory.
  void reset(int rows, int columns) {
    columns_ = columns + 1;
    counts_.assign(rowMajorSize(columns_, rows + 1), 0);
  }

  /// Adds to a count, before sumUp(); row and column must be in the table.
  void add(int row, int column, int count) { counts_[slot(row + 1, column + 1)] += count; }

  /// Must be called after the last add() and before the first sum().
  void sumUp() {
    const std::size_t row_size = slot(1, 0);
    for (std::size_t begin = row_size; begin < counts_.size(); begin += row_size) {
      int row_sum = 0;
      for (std::size_t i = begin; i < begin + row_size; ++i) {
        row_sum += counts_[i];
        counts_[i] = row_sum + counts_[i - row_size];
      }
    }
  }

  /// Returns the sum over rows [first_row, end_row) and columns [first_column, end_column), all in
  /// the table.
  int sum(int first_row, int end_row, int first_column, int end_column) const {
    return counts_[slot(end_row, end_column)] - counts_[slot(end_row, first_column)] -
           counts_[slot(first_row, end_column)] + counts_[slot(first_row, first_column)];
  }

 private:
  std::size_t slot(int row, int column) const { return rowMajorIndex(column, row, columns_); }

  int columns_ = 1;          ///< including one of zeros
  std::vector<int> counts_;  ///< starting with a row and a column of zeros
};

}  // namespace datmo
