#include "cell_objects.h"

#include "datmo_fusion/grid/rolling_grid.h"

namespace datmo {

namespace {

/// The object that a cell belongs to, out of those that are left.
std::vector<CellIndex> takeObject(CellIndex seed, RollingGrid<char>& left) {
  std::vector<CellIndex> object = {seed};
  left.at(seed) = 0;
  for (std::size_t i = 0; i < object.size(); ++i) {
    const CellIndex cell = object[i];
    for (int row = cell.row - 1; row <= cell.row + 1; ++row) {
      for (int column = cell.column - 1; column <= cell.column + 1; ++column) {
        if (left.atOrEmpty({column, row}) != 0) {
          left.at({column, row}) = 0;
          object.push_back({column, row});
        }
      }
    }
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
      objects.push_back(takeObject(cell, left));
    }
  }
  return objects;
}

}  // namespace datmo
