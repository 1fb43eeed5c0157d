// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nav_msgs/OccupancyGrid.h>

#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

/// Cell (0, 0) of the message is the window's lower left one; the frame is the vehicle's.
nav_msgs::OccupancyGrid toMessage(SensorGrid grid, const std::string& base_frame);

/// Ignores the frame. Messages hold the cell size as a float: it is rounded to whole micrometers,
/// so that grids of the same window have equal windows again.
///
/// Throws InputError (`bad_grid`) for a cell size that is not finite or larger than that of any
/// grid, an origin that is rotated, not on the lattice or out of range, a number of cells that is 0
/// or differs from width times height, and values outside -1 to 100; `bad_pose` for an origin that
/// is not a valid pose.
SensorGrid fromMessage(const nav_msgs::OccupancyGrid& message);

}  // namespace datmo
