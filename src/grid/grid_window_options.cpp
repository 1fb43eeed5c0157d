// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/grid_window_options.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

int cellsAlong(double length, double cell_size) {
  return std::max(1, static_cast<int>(std::lround(length / cell_size)));
}

/// Cells of about 50 bytes in a map: more do not fit in the memory of a vehicle's computer.
constexpr double kMaxCells = 2.5e7;

}  // namespace

void GridWindowOptions::visit(OptionVisitor& visitor) {
  visitor.number({"length", "m", "extent of the grid along x (thesis 3.3.1)", Tier::kPublic},
                 length, {1.0, 2000.0});
  visitor.number({"width", "m", "extent of the grid along y (thesis 3.3.1)", Tier::kPublic}, width,
                 {1.0, 2000.0});
  visitor.number({"cell_size", "m", "side of a cell (thesis 3.3.1)", Tier::kPublic}, cell_size,
                 {0.02, 5.0});
}

GridWindow GridWindowOptions::window() const {
  checkOptions(*this);
  const double cells = length / cell_size * (width / cell_size);
  if (cells > kMaxCells) {
    throw OptionError("length, width and cell_size make " + toText(cells) +
                      " cells: expected at most " + toText(kMaxCells));
  }
  const int columns = cellsAlong(length, cell_size);
  const int rows = cellsAlong(width, cell_size);
  return {cell_size, columns, rows, {-columns / 2, -rows / 2}};
}

}  // namespace datmo
