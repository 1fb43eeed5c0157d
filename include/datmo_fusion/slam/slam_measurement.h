// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/grid/sensor_grid.h"
#include "datmo_fusion/slam/grid_masked_scan.h"

namespace datmo {

/// The input of SLAM at one time: a scan, and with low-level fusion the fused grid of its stamp,
/// which decides how much of the scan is accepted and what others have seen besides
/// (GridMaskedScan). The functions below are called by GridSlam, in this order.
struct SlamMeasurement {
  const Scan& scan;
  const SensorGrid* grid = nullptr;  ///< null: the scan alone
};

/// A measurement as it is matched with the map and written to it.
struct PreparedScan {
  Scan compensated;     ///< for the vehicle's motion
  GridMaskedScan view;  ///< corrected by the grid, if there is one
  /// With only the scanner's own end points, if there are any: those of other sensors are off by
  /// their depth error, so the pose must not be matched with them, and they hide nothing.
  Scan own;
};

PreparedScan prepareScan(const SlamMeasurement& measurement, Scan compensated, GridEnds ends);

/// Returns the map's input from a grid: beam ends on what does not move, and occupied cells. What
/// only other sensors have seen is not used for matching scans, and is excluded if it belongs to a
/// moving object, whose depth they blur, or lies in space that the map knows to be free. `states`:
/// of the view's rays.
GridUpdate gridUpdateOf(const GridMaskedScan& view, const std::vector<PointState>& states,
                        const SensorGrid& grid, const OccupancyMap& map, const Pose2& base_in_map);

/// Removes beams of `measured` whose ends the grid does not confirm from `scan` and `states`, if
/// there are others: contradictory sensors are no evidence of either occupied or free space.
void removeConflictingBeams(const Scan& measured, const GridMaskedScan& view, Scan& scan,
                            std::vector<PointState>& states);

}  // namespace datmo
