// SPDX-License-Identifier: BSD-3-Clause
// The parts of OccupancyMap that concern cells beyond its window, and saved maps.
#include <algorithm>
#include <optional>
#include <utility>

#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo {

namespace {

/// s, age given to the cells of a restored map: longer than any drive.
constexpr float kLongAgo = 1e6F;

/// Number of the update in which restored cells were last changed; 0 would mean never.
constexpr std::uint32_t kFirstUpdate = 1;

/// Calls `visit(CellIndex)` for each cell of a window, row by row.
template <typename Visit>
void forEachCell(const GridWindow& window, Visit&& visit) {
  for (int row = window.corner.row; row < window.corner.row + window.rows; ++row) {
    for (int column = window.corner.column; column < window.corner.column + window.columns;
         ++column) {
      visit(CellIndex{column, row});
    }
  }
}

/// Returns the window, extended to include the cell.
GridWindow extended(GridWindow window, CellIndex cell) {
  const CellIndex end{std::max(window.corner.column + window.columns, cell.column + 1),
                      std::max(window.corner.row + window.rows, cell.row + 1)};
  window.corner = {std::min(window.corner.column, cell.column),
                   std::min(window.corner.row, cell.row)};
  window.columns = end.column - window.corner.column;
  window.rows = end.row - window.corner.row;
  return window;
}

}  // namespace

template <typename Visit>
void OccupancyMap::forEachKnownInWindow(Visit&& visit) const {
  forEachCell(window(), [&](CellIndex index) {
    if (const Cell& cell = cells_.at(index); isKnown(cell)) {
      visit(index, cell);
    }
  });
}

template <typename Visit>
void OccupancyMap::forEachKnown(Visit&& visit) const {
  outside_.forEach([&](CellIndex index, const Cell& cell) {
    // In a map being built, what came back into the window is only in the tiles until it is seen
    // again; a restored map has it in the window, too.
    const bool in_window = window().contains(index) && (is_restored_ || isKnown(cells_.at(index)));
    if (isKnown(cell) && !in_window) {
      visit(index, cell);
    }
  });
  forEachKnownInWindow(visit);
}

void OccupancyMap::centerOn(const Point2& position) {
  const GridWindow before = window();
  cells_.centerOn(position, [this](CellIndex index) {
    const Cell& cell = cells_.at(index);
    if (isKnown(cell)) {
      outside_.put(index, cell);
    }
  });
  if (is_restored_) {
    forEachCellOutside(window(), before,
                       [this](CellIndex index) { cells_.at(index) = outside_.at(index); });
  }
}

MapEvidence OccupancyMap::evidence() const {
  MapEvidence evidence{window().cell_size, {}};
  forEachKnown([&evidence](CellIndex index, const Cell& cell) {
    evidence.cells.push_back(evidenceOf(index, cell));
  });
  return evidence;
}

MapEvidence OccupancyMap::windowEvidence() const {
  MapEvidence evidence{window().cell_size, {}};
  evidence.cells.reserve(rowMajorSize(window().columns, window().rows));
  forEachKnownInWindow([&evidence](CellIndex index, const Cell& cell) {
    evidence.cells.push_back(evidenceOf(index, cell));
  });
  return evidence;
}

void OccupancyMap::recall(const std::vector<CellEvidence>& cells) {
  update_ = std::max(update_, kFirstUpdate);
  for (const CellEvidence& known : cells) {
    if (window().contains(known.cell)) {
      cells_.at(known.cell) = cellOf(known);
    }
  }
}

CellEvidence OccupancyMap::evidenceOf(CellIndex index, const Cell& cell) {
  return {index,        cell.log_odds, cell.last_hit - cell.first_hit,
          cell.refuted, cell.believed, cell.hits};
}

OccupancyMap::Cell OccupancyMap::cellOf(const CellEvidence& known) const {
  Cell cell;
  cell.updated = kFirstUpdate;
  change(cell, known.log_odds);
  cell.first_hit = now_ - known.age;
  cell.last_hit = now_;
  cell.mean_hit = now_;
  cell.refuted = known.refuted;
  cell.believed = known.believed;
  cell.hits = known.hits;
  return cell;
}

GridWindow OccupancyMap::extent() const {
  std::optional<GridWindow> extent;
  forEachKnown([&](CellIndex index, const Cell& /*cell*/) {
    extent = extended(extent.value_or(GridWindow{window().cell_size, 1, 1, index}), index);
  });
  return extent.value_or(GridWindow{window().cell_size, 1, 1, {}});
}

OccupancyMap OccupancyMap::restored(const Checked<OccupancyMapOptions>& options,
                                    const MapEvidence& evidence) {
  OccupancyMap map(options);
  map.is_restored_ = true;
  map.update_ = kFirstUpdate;
  for (const CellEvidence& known : evidence.cells) {
    Cell cell = map.cellOf(known);
    cell.mean_hit = -kLongAgo;
    map.outside_.putPermanently(known.cell, cell);
    if (map.window().contains(known.cell)) {
      map.cells_.at(known.cell) = cell;
    }
  }
  return map;
}

void OccupancyMap::merge(const OccupancyMap& other, const Pose2& other_in_map) {
  if (!other.first_stamp_) {
    return;
  }
  beginUpdate(*other.first_stamp_ + static_cast<double>(other.now_));
  const auto delay = static_cast<float>(secondsBetween(*first_stamp_, *other.first_stamp_));
  other.forEachKnown([&](CellIndex index, const Cell& cell) {
    if (isOccupied(cell)) {
      mergeOccupied(cell, other.window().centerOf(index), other_in_map, delay);
    }
  });
  mergeFree(other, other_in_map);
}

void OccupancyMap::mergeFree(const OccupancyMap& other, const Pose2& other_in_map) {
  const Pose2 map_in_other = other_in_map.inverse();
  const Eigen::Matrix2d rotation = map_in_other.rotation();
  forEachCell(window(), [&](CellIndex index) {
    const Point2 there = map_in_other.position() + rotation * window().centerOf(index);
    const Cell& from = other.cells_.atOrEmpty(other.window().cellAt(there));
    Cell& cell = cells_.at(index);
    // A surface may lie in another cell than the center of its cell: it takes precedence.
    if (isOccupied(from) || cell.updated == update_) {
      return;
    }
    cell.refuted += from.refuted;
    cell.believed += from.believed;
    if (isKnown(from)) {
      cell.updated = update_;
      change(cell, from.log_odds);
    }
  });
}

void OccupancyMap::mergeOccupied(const Cell& from, const Point2& center, const Pose2& other_in_map,
                                 float delay) {
  const bool has_hits = from.hits.count > 0.0F;
  const CellIndex index =
      window().cellAt(other_in_map * (has_hits ? center + from.hits.mean() : center));
  if (!window().contains(index)) {
    return;
  }
  Cell& cell = cells_.at(index);
  const bool is_new = !hasSurface(cell);
  if (is_new) {
    cell.hits = {};
  }
  cell.updated = update_;
  change(cell, from.log_odds);
  cell.refuted += from.refuted;
  cell.believed += from.believed;
  if (!has_hits) {
    return;
  }
  cell.first_hit =
      is_new ? from.first_hit + delay : std::min(cell.first_hit, from.first_hit + delay);
  cell.last_hit = is_new ? from.last_hit + delay : std::max(cell.last_hit, from.last_hit + delay);
  const float share = from.hits.count / (from.hits.count + cell.hits.count);
  cell.mean_hit += share * (from.mean_hit + delay - cell.mean_hit);
  const Point2 shift = other_in_map * center - window().centerOf(index);
  cell.hits.add(from.hits, other_in_map.rotation().cast<float>(), shift.cast<float>(), kMaxHits);
}

void OccupancyMap::setWindow(const GridWindow& window) {
  RollingGrid<Cell> cells(window, Cell{});
  outside_.forEachAround(window, [&](CellIndex index, const Cell& cell) {
    if (window.contains(index)) {
      cells.at(index) = cell;
    }
  });
  // Only now, since cells that leave the window may cause tiles to be dropped.
  forEachCell(cells_.window(), [&](CellIndex index) {
    if (!isKnown(cells_.at(index))) {
      return;
    }
    if (window.contains(index)) {
      cells.at(index) = cells_.at(index);
    } else {
      outside_.put(index, cells_.at(index));
    }
  });
  cells_ = std::move(cells);
}

}  // namespace datmo
