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
  double hit_probability = 0.8;   ///< of a cell that a grid has occupied
  double free_probability = 0.4;  ///< of one that it has free
  double min_probability = 0.02;  ///< to which a cell is clamped; 1 - it at the other end

  void visit(OptionVisitor& visitor);
};

/// The map that one sensor makes from its instantaneous grids: a rolling window of log-odds, as
/// OccupancyMap without what scan matching needs, in which evidence ages. What is not seen again
/// decays exponentially toward unknown: the closed form of a cell that changes its state at random
/// (Meyer-Delius et al., Occupancy grid models for robot mapping in changing environments, 2012),
/// with unknown as what it changes to.
class AgingMap {
 public:
  /// A window of at least one cell about the map's origin. Throws OptionError.
  AgingMap(const Checked<AgingMapOptions>& options, int columns, int rows, double cell_size);

  const GridWindow& window() const { return cells_.window(); }

  /// Moves the window with the vehicle (m, map frame); what is outside then is forgotten.
  void centerOn(const Point2& position) { cells_.centerOn(position); }

  /// Takes in a grid of the vehicle's frame, seen from `base_in_map`; by rising stamp. Each cell is
  /// updated once, by what grid_slam's map takes a hit and a beam that passes for, and an occupied
  /// one is never lost by rounding (as in movedGrid).
  void update(const SensorGrid& grid, const Pose2& base_in_map);

  /// Log-odds of a cell as they are worth at this time, not before it was seen; 0 where nothing is
  /// known.
  double logOdds(CellIndex cell, Stamp now) const;

  /// The window at this time, in the map's frame; what is as likely occupied as free, to a percent,
  /// is unknown.
  SensorGrid image(Stamp now) const;

 private:
  struct Cell {
    float log_odds = 0.0F;                                 ///< when it was seen last
    float seen = -std::numeric_limits<float>::infinity();  ///< s since the first grid
  };

  class Decay;

  void take(CellIndex cell, double log_odds_step, float now, Decay& decay);
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
