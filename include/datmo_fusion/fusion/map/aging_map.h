// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/grid/rolling_grid.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

struct AgingMapOptions {
  double time_constant = 60.0;    ///< s
  double hit_probability = 0.8;   ///< of a cell that a grid reports as occupied
  double free_probability = 0.4;  ///< of one that it reports as free
  double min_probability = 0.02;  ///< lower clamp of a cell; the upper one is 1 - this

  void visit(OptionVisitor& visitor);
};

/// The map that one sensor builds from its instantaneous grids: a rolling window of log odds, like
/// OccupancyMap without the data for scan matching, in which evidence ages. Cells that are not
/// observed again decay exponentially toward unknown: the closed form of a cell that changes its
/// state at random (Meyer-Delius et al., Occupancy grid models for robot mapping in changing
/// environments, 2012), with unknown as the limit.
class AgingMap {
 public:
  /// Creates a window of at least one cell about the map's origin. Throws OptionError.
  AgingMap(const Checked<AgingMapOptions>& options, int columns, int rows, double cell_size);

  const GridWindow& window() const { return cells_.window(); }

  /// Moves the window with the vehicle (m, map frame); cells that leave it are forgotten.
  void centerOn(const Point2& position) { cells_.centerOn(position); }

  /// Integrates a grid of the vehicle's frame, observed from `base_in_map`; stamps must rise. Each
  /// cell is updated once, with the log odds of the options, whose defaults are those of
  /// OccupancyMap; occupied cells are never lost by rounding (as in movedGrid).
  void update(const SensorGrid& grid, const Pose2& base_in_map);

  /// Returns the log odds of a cell, aged to `now` (unaged if observed later); 0 if unknown.
  double logOdds(CellIndex cell, Stamp now) const;

  /// Returns the window at `now`, in the map's frame; cells within a percent of 1/2 are unknown.
  SensorGrid image(Stamp now) const;

 private:
  struct Cell {
    float log_odds = 0.0F;                                 ///< at the last observation
    float seen = -std::numeric_limits<float>::infinity();  ///< s since the first grid, of the last
                                                           ///< observation
  };

  class Decay;

  void update(CellIndex cell, double log_odds_step, float now, Decay& decay);
  float timeOf(Stamp stamp) const {
    return first_stamp_ ? static_cast<float>(secondsBetween(*first_stamp_, stamp)) : 0.0F;
  }

  double time_constant_;  ///< s
  double hit_log_odds_;
  double free_log_odds_;
  double log_odds_limit_;
  RollingGrid<Cell> cells_;
  std::optional<Stamp> first_stamp_;
};

}  // namespace datmo
