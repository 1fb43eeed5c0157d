// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/map/aging_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/common/log_odds.h"
#include "datmo_fusion/grid/grid_resampling.h"

namespace datmo {

void AgingMapOptions::visit(OptionVisitor& visitor) {
  visitor.number({"time_constant", "s",
                  "time after which the evidence of a cell that is not seen again has decayed to "
                  "1/e: shorter than a car parks, and far longer than passing traffic hides a cell "
                  "(exponential forgetting: Meyer-Delius et al. 2012)"},
                 time_constant, {0.1, 1e6});
  visitor.number({"hit_probability", "1",
                  "occupancy of a cell that is occupied in a grid, as in grid_slam's map"},
                 hit_probability, {0.51, 0.99});
  visitor.number({"free_probability", "1",
                  "occupancy of a cell that is free in a grid, as there: weak, since thin objects "
                  "are missed more often than they are seen"},
                 free_probability, {0.01, 0.49});
  visitor.number({"min_probability", "1",
                  "a cell's occupancy stays between this and 1 - this, as in grid_slam's map"},
                 min_probability, {0.0001, 0.3});
}

/// Remaining share of evidence at one time. Most cells were last observed at the same time: the
/// exponential is recomputed only when that time differs.
class AgingMap::Decay {
 public:
  Decay(float now, double time_constant) : now_(now), time_constant_(time_constant) {}

  double logOddsOf(const Cell& cell) {
    if (cell.seen != seen_) {
      seen_ = cell.seen;
      // A later observation (a grid may be newer than its pose) has not aged.
      left_ = std::exp(std::min(0.0, static_cast<double>(seen_ - now_)) / time_constant_);
    }
    return left_ * static_cast<double>(cell.log_odds);
  }

 private:
  float now_;
  double time_constant_;
  float seen_ = std::numeric_limits<float>::quiet_NaN();  ///< of the last cell
  double left_ = 0.0;
};

AgingMap::AgingMap(const Checked<AgingMapOptions>& options, int columns, int rows, double cell_size)
    : time_constant_(options->time_constant),
      hit_log_odds_(logOddsOf(options->hit_probability)),
      free_log_odds_(logOddsOf(options->free_probability)),
      log_odds_limit_(logOddsOf(1.0 - options->min_probability)),
      cells_(columns, rows, cell_size, Cell{}) {}

double AgingMap::logOdds(CellIndex cell, Stamp now) const {
  return Decay(timeOf(now), time_constant_).logOddsOf(cells_.atOrEmpty(cell));
}

void AgingMap::update(CellIndex index, double log_odds_step, float now, Decay& decay) {
  if (!window().contains(index)) {
    return;
  }
  Cell& cell = cells_.at(index);
  if (cell.seen == now) {
    return;
  }
  cell.log_odds = static_cast<float>(
      std::clamp(decay.logOddsOf(cell) + log_odds_step, -log_odds_limit_, log_odds_limit_));
  cell.seen = now;
}

void AgingMap::update(const SensorGrid& grid, const Pose2& base_in_map) {
  if (!first_stamp_) {
    first_stamp_ = grid.stamp();
  }
  const float now = timeOf(grid.stamp());
  Decay decay(now, time_constant_);
  grid.forEach([&](CellIndex cell, Percent percent) {
    if (isOccupied(percent)) {
      update(window().cellAt(base_in_map * grid.window().centerOf(cell)), hit_log_odds_, now,
             decay);
    }
  });
  resample(grid, base_in_map, window(), [&](CellIndex cell, Percent percent) {
    if (isFree(percent)) {
      update(cell, free_log_odds_, now, decay);
    }
  });
}

SensorGrid AgingMap::image(Stamp now) const {
  SensorGrid image(now, window());
  Decay decay(timeOf(now), time_constant_);
  const CellIndex corner = window().corner;
  for (int row = corner.row; row < corner.row + window().rows; ++row) {
    for (int column = corner.column; column < corner.column + window().columns; ++column) {
      const Percent percent = toPercent(probabilityOf(decay.logOddsOf(cells_.at({column, row}))));
      image.at({column, row}) = percent == kUndecidedPercent ? kUnknownPercent : percent;
    }
  }
  return image;
}

}  // namespace datmo
