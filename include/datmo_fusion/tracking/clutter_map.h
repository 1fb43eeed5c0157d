// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/grid/rolling_grid.h"

namespace datmo {

struct ClutterMapOptions {
  double cell_size = 10.0;      ///< m
  double range = 60.0;          ///< m
  double learning_time = 10.0;  ///< s

  void visit(OptionVisitor& visitor);
};

/// Density of objects that belong to no confirmed target, around each position relative to the
/// vehicle: false alarms, and objects that come into view. Learned from previous scans (Musicki,
/// Suvorova, Morelande, Moran, Clutter map and target tracking, 2005).
class ClutterMap {
 public:
  explicit ClutterMap(const ClutterMapOptions& options);

  /// Returns the density of such objects per scan, 1/m^2, at a position in the vehicle's frame; 0
  /// if nothing was learned there.
  double density(const Point2& position) const { return densities_.atOrEmpty(cellAt(position)); }

  /// Learns from the positions of such objects in one scan (m, vehicle's frame), `seconds` >= 0
  /// after the last one.
  void learn(const std::vector<Point2>& unexplained, double seconds);

  /// Resets to the state after construction.
  void clear();

 private:
  CellIndex cellAt(const Point2& position) const { return densities_.window().cellAt(position); }

  ClutterMapOptions options_;
  RollingGrid<double> densities_;  ///< 1/m^2, about the vehicle
};

}  // namespace datmo
