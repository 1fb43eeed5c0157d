// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/grid_window_options.h"
#include "datmo_fusion/grid/rolling_grid.h"

namespace datmo {

struct HitGridOptions {
  GridWindowOptions window;
  int max_hits = 10;       ///< limit of a cell's count; 0: unlimited
  double cut_share = 0.1;  ///< of the highest smoothed count
  double min_age = 1.0;    ///< s, between first and last hit

  void visit(OptionVisitor& visitor);
};

/// Counts how often beams have ended in each cell around the vehicle, whatever its state in the map
/// (thesis 3.5): curbs and other permanent obstacles stand out, because nothing else is hit
/// repeatedly at one position.
class HitGrid {
 public:
  /// Throws OptionError, also if there are more cells than fit in memory.
  explicit HitGrid(const Checked<HitGridOptions>& options);

  const GridWindow& window() const { return cells_.window(); }

  /// Moves the window with the vehicle and counts the ends of the scan's beams.
  void update(const LabeledScan& scan);

  /// Moves the window so that `center` (m, map frame) lies in its middle cell; cells that are then
  /// outside are forgotten.
  void centerOn(const Point2& center);

  /// Counts a hit at a point, m, map frame, in ascending stamp order. One outside the window is
  /// ignored.
  void add(const Point2& point, Stamp stamp);

  /// Returns H of a cell; 0 outside the window.
  int hits(CellIndex cell) const { return cells_.atOrEmpty(cell).hits; }

  /// Returns the mean of the hits in a cell, m, map frame; its center if there are none.
  Point2 meanHit(CellIndex cell) const;

  /// Returns S of a cell: the hits in the 3 x 3 cells around it within the window (eq. 3.5.1).
  int smoothed(CellIndex cell) const { return cells_.atOrEmpty(cell).smoothed; }

  /// Returns the highest S of all cells.
  int highest() const { return highest_; }

  /// Returns S of a cell; 0 if it is less than `cut_share` of the highest (eq. 3.5.2) or, beyond
  /// the thesis, if its 3 x 3 cells have not been hit for `min_age`.
  int cutSmoothed(CellIndex index) const {
    const Cell& cell = cells_.atOrEmpty(index);
    const bool passes = cell.smoothed >= options_.cut_share * highest_ && isLasting(cell);
    return passes ? cell.smoothed : 0;
  }

  /// Returns whether the 3 x 3 cells around a cell have been hit for `min_age`: longer than a
  /// moving object stays in one position.
  bool isLasting(CellIndex index) const { return isLasting(cells_.atOrEmpty(index)); }

  /// Resets to the state after construction.
  void reset();

 private:
  struct Cell {
    std::int32_t hits = 0;
    std::int32_t smoothed = 0;
    Eigen::Vector2f mean = Eigen::Vector2f::Zero();  ///< m, of the hits, from the cell's center
    float first_hit = 0.0F;  ///< s since the first hit of the grid, in the 3 x 3 cells around
    float last_hit = 0.0F;   ///< s since the first hit of the grid, in the 3 x 3 cells around
  };

  bool isLasting(const Cell& cell) const {
    return static_cast<double>(cell.last_hit - cell.first_hit) >= options_.min_age;
  }

  /// Adds this (possibly negative) number to the sums of the cells around, if they lie in `counts`.
  void addAround(CellIndex center, int hits, const GridWindow& counts);
  void setSmoothed(CellIndex cell, int value);
  /// Removes a cell that is not in the `next` window.
  void leave(CellIndex cell, const GridWindow& next);
  void enter(CellIndex center);
  void touchAround(CellIndex center, Stamp stamp);

  HitGridOptions options_;
  int max_hits_;
  RollingGrid<Cell> cells_;
  /// Number of cells per value of S except 0, so that the highest is known when cells leave.
  std::vector<std::int32_t> cells_with_;
  int highest_ = 0;
  std::optional<Stamp> first_stamp_;
};

}  // namespace datmo
