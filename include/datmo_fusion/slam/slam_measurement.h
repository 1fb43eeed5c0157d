// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/grid/sensor_grid.h"
#include "datmo_fusion/slam/grid_masked_scan.h"

namespace datmo {

/// What SLAM takes at one time: a scan, and with low-level fusion the fused grid of its stamp,
/// which decides how far the scan stands and what others have seen beside it (GridMaskedScan).
/// Functions below are called by GridSlam, in this order.
struct SlamMeasurement {
  const Scan& scan;
  const SensorGrid* grid = nullptr;  ///< null: the scan alone
};

/// A scan of the measurement, compensated for the vehicle's motion, as the grid, if there is one,
/// lets it stand.
GridMaskedScan maskedScan(const SlamMeasurement& measurement, const Scan& compensated,
                          GridEnds ends);

/// The scan with the scanner's own end points alone, where there are any: what others see is off by
/// their depth's error, no point to match the pose with, and nothing that hides what is behind.
Scan measuredScan(const GridMaskedScan& view);

/// What the map takes of a grid: where beams end on what does not move, and occupied cells. What
/// others alone have seen is no point to match scans with, and is excluded where it belongs to a
/// mover, whose depth they blur, or lies in space that the map knows to be free. `states`: of the
/// view's rays.
GridUpdate gridUpdateOf(const GridMaskedScan& view, const std::vector<PointState>& states,
                        const SensorGrid& grid, const OccupancyMap& map, const Pose2& base_in_map);

/// Removes the beams of `measured` whose ends the grid does not confirm from `scan` and `states`,
/// if there are others: sensors that contradict each other give no evidence, neither of occupied
/// nor of free space.
void removeConflictingBeams(const Scan& measured, const GridMaskedScan& view, Scan& scan,
                            std::vector<PointState>& states);

}  // namespace datmo
