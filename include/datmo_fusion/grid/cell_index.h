// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace datmo {

/// A cell of the infinite lattice that is fixed to the map frame: column along x, row along y. The
/// lower left corner of cell (0, 0) is the frame's origin. A rolling window covers a part of the
/// lattice; a cell keeps its index while the window moves.
struct CellIndex {
  int column = 0;
  int row = 0;
};

inline bool operator==(CellIndex a, CellIndex b) { return a.column == b.column && a.row == b.row; }
inline bool operator!=(CellIndex a, CellIndex b) { return !(a == b); }

/// Returns the cell that contains this one in a lattice of the same origin whose cells are `side`
/// >= 1 times as large.
inline CellIndex inCoarserLattice(CellIndex cell, int side) {
  const auto index = [side](int fine) { return fine >= 0 ? fine / side : -1 - (-1 - fine) / side; };
  return {index(cell.column), index(cell.row)};
}

}  // namespace datmo
