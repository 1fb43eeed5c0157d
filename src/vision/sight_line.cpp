// SPDX-License-Identifier: BSD-3-Clause
#include "sight_line.h"

#include <algorithm>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/grid/ray_walk.h"

namespace datmo {

namespace {

/// Raises the value of a cell: where one line sees an obstacle, the cell is not free for its
/// neighbor.
void raise(CellIndex cell, Percent percent, SensorGrid& grid) {
  grid.at(cell) = std::max(grid.at(cell), percent);
}

}  // namespace

SightLine sightLine(const GroundView& view, const Point2& direction, const SensorGrid& scanned,
                    double range, double obstacle_height) {
  const GridWindow& window = scanned.window();
  SightLine line;
  bool ended = false;
  walkRay(window, view.position(), view.position() + range * direction, [&](CellIndex cell) {
    if (ended || !window.contains(cell)) {
      return;
    }
    const bool is_hit = isOccupied(scanned.at(cell));
    ended = !is_hit && !line.hits.empty();
    const Point2 center = window.centerOf(cell);
    const auto patch = view.patch(center, window.cell_size, is_hit ? obstacle_height : 0.0);
    if (is_hit && !patch) {
      ended = true;  // seen only by the scanner, and whatever is behind it
    } else if (!ended && patch) {
      (is_hit ? line.hits : line.open).push_back({cell, (center - view.position()).norm(), *patch});
    }
  });
  return line;
}

void SightLines::fill(SensorGrid& grid) const {
  for (const Point2& direction :
       view_.directions(options_.effective_range, options_.window.cell_size)) {
    write(sightLine(view_, direction, scanned_, options_.effective_range,
                    options_.min_obstacle_height),
          grid);
  }
}

void SightLines::write(const SightLine& line, SensorGrid& grid) const {
  const Percent free = toPercent(options_.free_probability);
  const auto mark = [&](std::size_t from, std::size_t to, Percent percent) {
    for (std::size_t i = from; i < to; ++i) {
      raise(line.open[i].cell, percent, grid);
    }
  };
  std::optional<std::size_t> other;  // the first cell of other color since the last road cell
  for (std::size_t i = 0; i < line.open.size(); ++i) {
    if (!isRoad(line.open[i])) {
      other = other.value_or(i);
      continue;
    }
    raise(line.open[i].cell, free, grid);
    if (other) {
      const bool hides = mayHide(line.open[*other].distance, line.open[i].distance);
      mark(*other, i, hides ? kUndecidedPercent : free);
      other.reset();
    }
  }
  if (other) {
    mark(*other, line.open.size(), kUndecidedPercent);
    const double foot = line.open[*other].distance;
    for (std::size_t i = 0; line.hits.empty() && i < *other; ++i) {
      if (line.open[i].distance > foot - rangeSigma(foot)) {
        raise(line.open[i].cell, kUndecidedPercent, grid);
      }
    }
  }
  const bool seen = std::any_of(line.hits.begin(), line.hits.end(),
                                [this](const auto& step) { return !isRoad(step); });
  for (const SightLine::Step& step : line.hits) {
    raise(step.cell, seen ? toPercent(options_.occupied_probability) : kUndecidedPercent, grid);
  }
}

bool SightLines::mayHide(double from, double to) const {
  return view_.height() * (to - from) / to >= options_.min_obstacle_height;
}

bool SightLines::isRoad(const SightLine::Step& step) const {
  return pixels_.share(step.patch) >= options_.min_road_share;
}

double SightLines::rangeSigma(double distance) const {
  return options_.pitch_sigma * (square(distance) + square(view_.height())) / view_.height();
}

}  // namespace datmo
