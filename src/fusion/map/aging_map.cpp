// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/map/aging_map.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/log_odds.h"
#include "datmo_fusion/grid/grid_resampling.h"

namespace datmo {

void AgingMapOptions::visit(OptionVisitor& visitor) {
  visitor.number({"time_constant", "s",
                  "after which evidence of a cell that is not seen again is worth 1/e: less than a "
                  "parked car stays, and far more than a cell is hidden by what drives by "
                  "(exponential forgetting: Meyer-Delius et al. 2012)"},
                 time_constant, {0.1, 1e6});
  visitor.number({"hit_probability", "1",
                  "occupancy of a cell that a grid has occupied, as in "
                  "grid_slam's map"},
                 hit_probability, {0.51, 0.99});
  visitor.number({"free_probability", "1",
                  "occupancy of a cell that a grid has free, as there: weak, for thin things are "
                  "missed more often than they are seen"},
                 free_probability, {0.01, 0.49});
  visitor.number({"min_probability", "1",
                  "a cell's occupancy stays between this and 1 - this, as in grid_slam's map"},
                 min_probability, {0.0001, 0.3});
}

double AgingMap::aged(const Cell& cell, float now) const {
  return static_cast<double>(cell.log_odds) *
         std::exp(static_cast<double>(cell.seen - now) / options_.time_constant);
}

double AgingMap::logOdds(CellIndex cell, Stamp now) const {
  return aged(cells_.atOrEmpty(cell), timeOf(now));
}

void AgingMap::take(CellIndex index, double log_odds_step, float now) {
  if (!window().contains(index)) {
    return;
  }
  Cell& cell = cells_.at(index);
  if (cell.seen == now) {
    return;
  }
  const double limit = logOddsOf(1.0 - options_.min_probability);
  cell.log_odds = static_cast<float>(std::clamp(aged(cell, now) + log_odds_step, -limit, limit));
  cell.seen = now;
}

void AgingMap::update(const SensorGrid& grid, const Pose2& base_in_map) {
  if (!first_stamp_) {
    first_stamp_ = grid.stamp();
  }
  const float now = timeOf(grid.stamp());
  const double hit = logOddsOf(options_.hit_probability);
  const double free = logOddsOf(options_.free_probability);
  grid.forEach([&](CellIndex cell, Percent percent) {
    if (isOccupied(percent)) {
      take(window().cellAt(base_in_map * grid.window().centerOf(cell)), hit, now);
    }
  });
  resample(grid, base_in_map, window(), [&](CellIndex cell, Percent percent) {
    if (isFree(percent)) {
      take(cell, free, now);
    }
  });
}

SensorGrid AgingMap::image(Stamp now) const {
  SensorGrid image(now, window());
  const float time = timeOf(now);
  const CellIndex corner = window().corner;
  for (int row = corner.row; row < corner.row + window().rows; ++row) {
    for (int column = corner.column; column < corner.column + window().columns; ++column) {
      const Percent percent = toPercent(probabilityOf(aged(cells_.at({column, row}), time)));
      image.at({column, row}) = percent == kUndecidedPercent ? kUnknownPercent : percent;
    }
  }
  return image;
}

}  // namespace datmo
