// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

/// Returns the grid as the vehicle would have seen it at another time, in the same window.
///
/// `old_base_in_new`: pose of the vehicle at the grid's stamp in its frame at `stamp`. Each cell
/// takes the value at its center; no occupied cell is lost by rounding. A free cell within
/// `mover_distance` (m, >= 0: how far a mover may have traveled in between) of an occupied one,
/// from center to center, becomes unknown: a mover may be there by now.
SensorGrid movedGrid(const SensorGrid& grid, Stamp stamp, const Pose2& old_base_in_new,
                     double mover_distance);

}  // namespace datmo
