#pragma once

#include <vector>

#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

/// The occupied cells of a grid, those together that touch each other, also at a corner only; each
/// object begins with its first cell in the grid's order, and so do the objects.
std::vector<std::vector<CellIndex>> objectsIn(const SensorGrid& grid);

}  // namespace datmo
