// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

/// Which points SLAM uses as the obstacles of a fused grid.
enum class GridEnds {
  kScan,   ///< the ends of beams in occupied cells, exact to the range noise
  kCells,  ///< the cells' centers (thesis 3.2.5)
};

/// A scan, corrected by the fused grid of the same stamp: what other sensors refute is removed, and
/// what they add is included.
struct GridMaskedScan {
  /// The beams. A beam that ended in a cell that is not occupied has no hit; one without a hit of
  /// its own ends at the first occupied cell along it. Blind beams stay blind, unless the whole
  /// scan is blind.
  Scan scan;
  /// Per ray of the scan: whether its end was measured by the scanner, not taken from a cell;
  /// empty: all were, as there is no grid.
  std::vector<bool> measured;
  bool any_measured = false;
  /// Centers of the occupied cells in which no beam ends, m, base frame.
  std::vector<Point2> cells;
  /// Ends of beams in free cells, m, base frame.
  std::vector<Point2> refuted;

  bool isMeasured(std::size_t ray) const { return measured.empty() || measured[ray]; }
};

/// Corrects a scan by a grid, both in the vehicle's frame at the same time. If `scan` has no rays
/// (the scanner is silent), the beams of its field are made from the grid alone.
GridMaskedScan maskScanWithGrid(const SensorGrid& grid, const Scan& scan, GridEnds ends);

/// Returns those of the `positions` (m, base frame) that are not connected to any of the `seeds`
/// by adjacent occupied cells, so that they do not belong to the same objects.
std::vector<Point2> excludeConnectedTo(const std::vector<Point2>& seeds, const SensorGrid& grid,
                                       const std::vector<Point2>& positions);

/// Returns the grid with free cells next to occupied ones set to unknown: their position is only
/// known to within a cell, and a map with a different lattice must not free a surface's edge.
SensorGrid withoutFreeEdges(const SensorGrid& grid);

}  // namespace datmo
