// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

#include "made_stereo.h"

#include "datmo_fusion/grid/neighborhood.h"
#include "datmo_fusion/sensor_model/stereo_grid.h"

/// Grids of simulated clouds, and their contents.
namespace datmo::stereo_grids {

inline constexpr Percent kOccupied = 80;
inline constexpr Percent kFree = 20;

inline StereoGridOptions onFlatRoad() {
  StereoGridOptions options;
  options.road.estimate = false;
  return options;
}

inline SensorGrid gridOf(MadeCloud& made, const StereoGridOptions& options = StereoGridOptions()) {
  return StereoGridModel(options).grid(made.cloud()).grid;
}

inline SensorGrid gridOf(const MadeScene& scene,
                         const StereoGridOptions& options = StereoGridOptions()) {
  MadeCloud made(scene);
  return gridOf(made, options);
}

inline Percent at(const SensorGrid& grid, double x, double y) {
  return grid.atOrUnknown(grid.window().cellAt({x, y}));
}

inline std::size_t count(const SensorGrid& grid, Percent percent) {
  return static_cast<std::size_t>(std::count(grid.cells().begin(), grid.cells().end(), percent));
}

/// Returns whether a cell or one of its eight neighbors is occupied.
inline bool isOccupiedNear(const SensorGrid& grid, CellIndex cell) {
  return anyNeighbor(cell, 1, [&grid](CellIndex one) { return isOccupied(grid.atOrUnknown(one)); });
}

}  // namespace datmo::stereo_grids
