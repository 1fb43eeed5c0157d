// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/clutter_map.h"

#include <cmath>

namespace datmo {

namespace {

RollingGrid<double> emptyGrid(const ClutterMapOptions& options) {
  const int cells = 2 * static_cast<int>(std::ceil(options.range / options.cell_size));
  return {cells, cells, options.cell_size, 0.0};
}

}  // namespace

void ClutterMapOptions::visit(OptionVisitor& visitor) {
  visitor.number({"cell_size", "m", "side of the cells whose false alarms are counted together"},
                 cell_size, {0.5, 100.0});
  visitor.number(
      {"range", "m", "range around the vehicle in which false objects are counted", Tier::kPublic},
      range, {1.0, 500.0});
  visitor.number({"learning_time", "s", "time constant of the count"}, learning_time,
                 {0.1, 1000.0});
}

ClutterMap::ClutterMap(const ClutterMapOptions& options)
    : options_(options), densities_(emptyGrid(options)) {}

void ClutterMap::learn(const std::vector<Point2>& unexplained, double seconds) {
  const double gain = 1.0 - std::exp(-seconds / options_.learning_time);
  const GridWindow& window = densities_.window();
  for (int row = window.corner.row; row < window.corner.row + window.rows; ++row) {
    for (int column = window.corner.column; column < window.corner.column + window.columns;
         ++column) {
      densities_.at({column, row}) *= 1.0 - gain;
    }
  }
  for (const Point2& position : unexplained) {
    const CellIndex cell = cellAt(position);
    if (window.contains(cell)) {
      densities_.at(cell) += gain / (options_.cell_size * options_.cell_size);
    }
  }
}

void ClutterMap::clear() { densities_ = emptyGrid(options_); }

}  // namespace datmo
