// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/grid/grid_window_options.h"
#include "datmo_fusion/grid/rolling_grid.h"
#include "datmo_fusion/road/border_scan.h"

namespace datmo {

struct PassageGridOptions {
  PassageGridOptions();

  GridWindowOptions window;
  int min_hits = 2;  ///< 1
  /// 0 to 1: minimum share of a cell's beams, ending or passing, that end in a cell that is not
  /// free: moving objects leave fewer
  double hit_share = 0.15;
  double end_margin = 0.7;  ///< m
  int max_beams = 1000;     ///< 1

  void visit(OptionVisitor& visitor);
};

/// For each cell around the vehicle the numbers of beams that ended in it and that passed it.
class PassageGrid {
 public:
  enum class State : std::uint8_t { kUnknown, kFree, kOccupied };

  /// Throws OptionError, also if the grid would not fit in memory.
  explicit PassageGrid(const Checked<PassageGridOptions>& options);

  /// Moves the window with the scanner and counts the scan's beams.
  void update(const BorderScan& scan);

  /// State of the cell at a point, m, map frame; unknown outside the window.
  State at(const Point2& point) const;

  /// Forgets everything, as after construction.
  void reset();

 private:
  struct Cell {
    std::int32_t hits = 0;
    std::int32_t passages = 0;
  };

  void count(CellIndex cell, int hits, int passages);

  PassageGridOptions options_;
  RollingGrid<Cell> cells_;
};

}  // namespace datmo
