#include "cell_objects.h"

namespace datmo {

namespace {

/// The object that a cell belongs to; those of its cells become unknown in `left`.
std::vector<CellIndex> takeObject(CellIndex seed, SensorGrid& left) {
  std::vector<CellIndex> object = {seed};
  left.at(seed) = kUnknownPercent;
  for (std::size_t i = 0; i < object.size(); ++i) {
    const CellIndex cell = object[i];
    for (int row = cell.row - 1; row <= cell.row + 1; ++row) {
      for (int column = cell.column - 1; column <= cell.column + 1; ++column) {
        if (isOccupied(left.atOrUnknown({column, row}))) {
          left.at({column, row}) = kUnknownPercent;
          object.push_back({column, row});
        }
      }
    }
  }
  return object;
}

}  // namespace

std::vector<std::vector<CellIndex>> objectsIn(const SensorGrid& grid) {
  std::vector<std::vector<CellIndex>> objects;
  SensorGrid left = grid;
  grid.forEach([&](CellIndex cell, Percent /*percent*/) {
    if (isOccupied(left.at(cell))) {
      objects.push_back(takeObject(cell, left));
    }
  });
  return objects;
}

}  // namespace datmo
