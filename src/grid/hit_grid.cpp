// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/hit_grid.h"

#include <algorithm>

#include "datmo_fusion/grid/neighborhood.h"

namespace datmo {

namespace {

/// Nine times this, and the table of all values up to there, are still small.
constexpr int kSaturation = 100000;

}  // namespace

void HitGridOptions::visit(OptionVisitor& visitor) {
  window.visit(visitor);
  visitor.integer({"max_hits", "1",
                   "maximum count of a cell: a stationary vehicle hits the same cells over and "
                   "over, which would drown what it sees later; 0: no maximum (thesis 3.5)"},
                  max_hits, {0, kSaturation});
  visitor.number({"cut_share", "1",
                  "cells with a smoothed count below this share of the highest are noise or left "
                  "by moving objects (thesis 3.5.2: 0.1)"},
                 cut_share, {0.0, 1.0});
  visitor.number({"min_age", "s",
                  "minimum time between the first and the last hit in and around a cell: a passing "
                  "object covers a cell for less; 0: any (thesis)"},
                 min_age, {0.0, 60.0});
}

HitGrid::HitGrid(const Checked<HitGridOptions>& options)
    : options_(*options),
      max_hits_(options->max_hits > 0 ? options->max_hits : kSaturation),
      cells_(options->window.window(), Cell{}),
      cells_with_(1, 0) {}

void HitGrid::update(const LabeledScan& scan) {
  const Pose2& base_in_map = scan.base_in_map.pose;
  centerOn(base_in_map.position());
  for (const ScanPoint& point : scan.points) {
    add(base_in_map * point.position, scan.stamp);
  }
}

void HitGrid::centerOn(const Point2& center) {
  const GridWindow old = window();
  const GridWindow next = cells_.windowOn(center);
  cells_.centerOn(center, [&](CellIndex cell) { leave(cell, next); });
  forEachCellOutside(window(), old, [&](CellIndex cell) { enter(cell); });
}

void HitGrid::leave(CellIndex cell, const GridWindow& next) {
  if (const int hits = cells_.at(cell).hits; hits > 0) {
    addAround(cell, -hits, next);
  }
  setSmoothed(cell, 0);
}

void HitGrid::enter(CellIndex center) {
  int sum = 0;
  Cell& entered = cells_.at(center);
  forEachNeighbor(center, [&](CellIndex index) {
    const Cell& cell = cells_.atOrEmpty(index);
    sum += cell.hits;
    if (cell.hits > 0) {
      entered.first_hit = entered.last_hit = std::max(entered.last_hit, cell.last_hit);
    }
  });
  setSmoothed(center, sum);
}

void HitGrid::addAround(CellIndex center, int hits, const GridWindow& counts) {
  forEachNeighbor(center, [&](CellIndex cell) {
    if (window().contains(cell) && counts.contains(cell)) {
      setSmoothed(cell, cells_.at(cell).smoothed + hits);
    }
  });
}

void HitGrid::setSmoothed(CellIndex index, int value) {
  Cell& cell = cells_.at(index);
  if (cell.smoothed == value) {
    return;
  }
  if (cell.smoothed > 0) {
    --cells_with_[static_cast<std::size_t>(cell.smoothed)];
  }
  cell.smoothed = value;
  if (value > 0) {
    if (static_cast<std::size_t>(value) >= cells_with_.size()) {
      cells_with_.resize(static_cast<std::size_t>(value) + 1, 0);
    }
    ++cells_with_[static_cast<std::size_t>(value)];
    highest_ = std::max(highest_, value);
  }
  while (highest_ > 0 && cells_with_[static_cast<std::size_t>(highest_)] == 0) {
    --highest_;
  }
}

void HitGrid::touchAround(CellIndex center, Stamp stamp) {
  if (!first_stamp_) {
    first_stamp_ = stamp;
  }
  const float now = static_cast<float>(secondsBetween(*first_stamp_, stamp));
  forEachNeighbor(center, [&](CellIndex index) {
    if (window().contains(index)) {
      Cell& cell = cells_.at(index);
      cell.last_hit = now;
      cell.first_hit = cell.smoothed == 0 ? now : cell.first_hit;
    }
  });
}

void HitGrid::add(const Point2& point, Stamp stamp) {
  const CellIndex index = window().cellAt(point);
  if (!window().contains(index)) {
    return;
  }
  touchAround(index, stamp);
  Cell& cell = cells_.at(index);
  if (cell.hits < max_hits_) {
    ++cell.hits;
    addAround(index, 1, window());
  }
  // At max_hits the mean follows recent measurements.
  const Eigen::Vector2f offset = (point - window().centerOf(index)).cast<float>();
  cell.mean += (offset - cell.mean) / static_cast<float>(cell.hits);
}

Point2 HitGrid::meanHit(CellIndex cell) const {
  return window().centerOf(cell) + cells_.atOrEmpty(cell).mean.cast<double>();
}

void HitGrid::reset() { *this = HitGrid(options_); }

}  // namespace datmo
