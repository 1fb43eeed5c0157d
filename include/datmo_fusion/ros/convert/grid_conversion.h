// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nav_msgs/OccupancyGrid.h>

#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

/// Cell (0, 0) of the message is the window's lower left one; the frame is the vehicle's.
nav_msgs::OccupancyGrid toMessage(SensorGrid grid, const std::string& base_frame);

/// The frame is not looked at. Messages hold the cell size as a float: it is taken as the whole
/// number of micrometers that is meant, so that grids of the same window have equal windows again.
///
/// Throws InputError (`bad_grid`): a cell size that is not finite or beyond that of any grid, an
/// origin that is turned, not on the lattice or beyond any grid, another number of cells than
/// width and height say, or none, and cells beyond -1 to 100; `bad_pose` for an origin that is no
/// pose.
SensorGrid fromMessage(const nav_msgs::OccupancyGrid& message);

}  // namespace datmo
