// SPDX-License-Identifier: BSD-3-Clause
#include "cell_objects.h"

#include "datmo_fusion/grid/neighborhood.h"
#include "datmo_fusion/grid/rolling_grid.h"

namespace datmo {

namespace {

/// Extracts the object that a cell belongs to from the remaining cells.
std::vector<CellIndex> extractObject(CellIndex seed, RollingGrid<char>& left) {
  std::vector<CellIndex> object = {seed};
  left.at(seed) = 0;
  for (std::size_t i = 0; i < object.size(); ++i) {
    const CellIndex center = object[i];
    forEachNeighbor(center, [&](CellIndex cell) {
      if (left.atOrEmpty(cell) != 0) {
        left.at(cell) = 0;
        object.push_back(cell);
      }
    });
  }
  return object;
}

}  // namespace

std::vector<std::vector<CellIndex>> objectsOf(const std::vector<CellIndex>& cells,
                                              const GridWindow& window) {
  RollingGrid<char> left(window, 0);
  for (const CellIndex cell : cells) {
    left.at(cell) = 1;
  }
  std::vector<std::vector<CellIndex>> objects;
  for (const CellIndex cell : cells) {
    if (left.at(cell) != 0) {
      objects.push_back(extractObject(cell, left));
    }
  }
  return objects;
}

}  // namespace datmo
