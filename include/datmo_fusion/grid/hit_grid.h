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
  int max_hits = 10;       ///< that a cell counts; 0: all
  double cut_share = 0.1;  ///< of the highest smoothed count
  double min_age = 1.0;    ///< s, between first and last hit

  void visit(OptionVisitor& visitor);
};

/// How often beams have ended in each cell around the vehicle, whatever their state in the map
/// (thesis 3.5): curbs and other permanent obstacles stand out, as nothing else is hit again and
/// again at one position.
class HitGrid {
 public:
  /// Throws OptionError, also for more cells than any memory holds.
  explicit HitGrid(const Checked<HitGridOptions>& options);

  const GridWindow& window() const { return cells_.window(); }

  /// Moves the window with the vehicle and counts the ends of the scan's beams.
  void update(const LabeledScan& scan);

  /// Moves the window so that `center` (m, map frame) lies in its middle cell; what is outside then
  /// is forgotten.
  void centerOn(const Point2& center);

  /// Counts a hit at a point, m, map frame; one outside of the window is nothing. By rising stamps.
  void add(const Point2& point, Stamp stamp);

  /// H of a cell; 0 outside of the window.
  int hits(CellIndex cell) const { return cells_.atOrEmpty(cell).hits; }

  /// Mean of the hits in a cell, m, map frame; its center where there are none.
  Point2 meanHit(CellIndex cell) const;

  /// S of a cell: the hits in the 3 x 3 cells around it that are in the window (eq. 3.5.1).
  int smoothed(CellIndex cell) const { return cells_.atOrEmpty(cell).smoothed; }

  /// Highest S of all cells.
  int highest() const { return highest_; }

  /// S of a cell; 0 where it is less than `cut_share` of the highest (eq. 3.5.2) or, beyond the
  /// thesis, where the 3 x 3 cells have not been hit for `min_age`.
  int cutSmoothed(CellIndex index) const {
    const Cell& cell = cells_.atOrEmpty(index);
    const bool passes = cell.smoothed >= options_.cut_share * highest_ && isLasting(cell);
    return passes ? cell.smoothed : 0;
  }

  /// Whether the 3 x 3 cells around a cell have been hit for `min_age`: longer than what moves
  /// stays at a position.
  bool isLasting(CellIndex index) const { return isLasting(cells_.atOrEmpty(index)); }

  /// Forgets all, as at the start.
  void reset();

 private:
  struct Cell {
    std::int32_t hits = 0;
    std::int32_t smoothed = 0;
    Eigen::Vector2f mean = Eigen::Vector2f::Zero();  ///< m, of the hits from the cell's center
    float first_hit = 0.0F;  ///< s since the first of all, in the 3 x 3 cells around
    float last_hit = 0.0F;   ///< s since the first of all, in the 3 x 3 cells around
  };

  bool isLasting(const Cell& cell) const {
    return static_cast<double>(cell.last_hit - cell.first_hit) >= options_.min_age;
  }

  /// As much more (or less) for the sums of the cells around, of those that `counts` in a window.
  void addAround(CellIndex center, int hits, const GridWindow& counts);
  void setSmoothed(CellIndex cell, int value);
  /// Takes a cell out that is not in the `next` window.
  void leave(CellIndex cell, const GridWindow& next);
  void enter(CellIndex center);
  void touchAround(CellIndex center, Stamp stamp);

  HitGridOptions options_;
  int max_hits_;
  RollingGrid<Cell> cells_;
  /// How many cells have each S but 0, so that the highest is known when some leave.
  std::vector<std::int32_t> cells_with_;
  int highest_ = 0;
  std::optional<Stamp> first_stamp_;
};

}  // namespace datmo
