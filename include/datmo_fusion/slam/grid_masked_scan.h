// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

/// Which points the SLAM takes for the obstacles of a fused grid.
enum class GridEnds {
  kScan,   ///< where a beam ends in an occupied cell: its end, exact to the range noise
  kCells,  ///< the cells' centers (thesis 3.2.5)
};

/// A scan, corrected by the fused grid of the same time: what other sensors refute is removed,
/// and what they add is included.
struct GridMaskedScan {
  /// The beams. One that ended in a cell which is not occupied has no hit; one without a hit of its
  /// own ends at the first occupied cell along it. Blind beams stay blind, unless the whole scan
  /// is.
  Scan scan;
  /// For each ray of the scan: its end is a measurement of the scanner, not a cell.
  std::vector<bool> measured;
  bool any_measured = false;
  /// Centers of the occupied cells in which no beam ends, m, base frame.
  std::vector<Point2> cells;
  /// Ends of beams in cells that are free, m, base frame.
  std::vector<Point2> refuted;
};

/// Both in the vehicle's frame at the same time; `scan` without rays (the scanner is silent) makes
/// beams of its field out of the grid alone.
GridMaskedScan maskScanWithGrid(const SensorGrid& grid, const Scan& scan, GridEnds ends);

/// Those of the points (m, base frame) that are not connected with any of the `seeds` by occupied
/// adjacent cells: what does not belong to the same objects.
std::vector<Point2> excludeConnectedTo(const std::vector<Point2>& seeds, const SensorGrid& grid,
                                       const std::vector<Point2>& positions);

/// The grid without free cells beside occupied ones: where those lie is known to within a cell
/// only, and a map whose cells lie otherwise must not take a surface's edge for free.
SensorGrid withoutFreeEdges(const SensorGrid& grid);

}  // namespace datmo
