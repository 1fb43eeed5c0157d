// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/grid/cell_index.h"

namespace datmo {

/// Returns whether `test(CellIndex)` holds for a cell within `reach` columns and rows of another
/// one, including itself. Tests row by row and stops at the first match.
template <typename Test>
bool anyNeighbor(CellIndex center, int reach, Test&& test) {
  for (int row = center.row - reach; row <= center.row + reach; ++row) {
    for (int column = center.column - reach; column <= center.column + reach; ++column) {
      if (test(CellIndex{column, row})) {
        return true;
      }
    }
  }
  return false;
}

/// Calls `visit(CellIndex)` for a cell and its eight neighbors, row by row.
template <typename Visit>
void forEachNeighbor(CellIndex center, Visit&& visit) {
  anyNeighbor(center, 1, [&visit](CellIndex cell) {
    visit(cell);
    return false;
  });
}

}  // namespace datmo
