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
  bool beyond = false;
  bool is_hidden = false;  // perhaps, by an obstacle that the image does not show
  walkRay(window, view.position(), view.position() + range * direction, [&](CellIndex cell) {
    const Percent percent = scanned.atOrUnknown(cell);
    const bool is_hit = isOccupied(percent);
    if (is_hidden || !window.contains(cell) || (beyond && percent == kUnknownPercent)) {
      return;
    }
    beyond |= is_hit;
    const Point2 center = window.centerOf(cell);
    const auto patch = view.patch(center, window.cell_size, is_hit ? obstacle_height : 0.0);
    if (patch) {
      line.push_back({cell, (center - view.position()).norm(), *patch, is_hit});
    }
    is_hidden = is_hit && !patch;
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
  std::optional<std::size_t> other;  // the first cell of other color since the last road cell
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_road = isRoad(line[i]);
    if (line[i].is_hit) {
      raise(line[i].cell, is_road ? kUndecidedPercent : toPercent(options_.occupied_probability),
            grid);
    }
    if (!is_road) {
      other = other.value_or(i);
    } else if (!line[i].is_hit) {
      const bool hides = other && mayHide(line[*other].distance, line[i].distance);
      for (std::size_t j = other.value_or(i); j <= i; ++j) {
        raise(line[j].cell, hides && j < i ? kUndecidedPercent : free, grid);
      }
      other.reset();
    }
  }
  if (other) {
    writeEnd(line, *other, grid);
  }
}

void SightLines::writeEnd(const SightLine& line, std::size_t foot, SensorGrid& grid) const {
  const auto from_foot = line.begin() + static_cast<std::ptrdiff_t>(foot);
  const bool is_located =
      std::any_of(from_foot, line.end(), [](const SightStep& step) { return step.is_hit; });
  const double distance = line[foot].distance;
  const double from = is_located ? distance : distance - rangeSigma(distance);
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i >= foot || line[i].distance > from) {
      raise(line[i].cell, kUndecidedPercent, grid);
    }
  }
}

bool SightLines::mayHide(double from, double to) const {
  return view_.height() * (to - from) / to >= options_.min_obstacle_height;
}

bool SightLines::isRoad(const SightStep& step) const { return pixels_.evidence(step.patch) >= 0.0; }

double SightLines::rangeSigma(double distance) const {
  return options_.pitch_sigma * (square(distance) + square(view_.height())) / view_.height();
}

}  // namespace datmo
