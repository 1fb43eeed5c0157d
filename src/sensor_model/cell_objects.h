// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/grid/grid_window.h"

namespace datmo {

/// Cells of a window sorted into objects: those together that touch each other, also at a corner
/// only. `cells`: inside of the window, each once. Objects in the order of their first cells.
std::vector<std::vector<CellIndex>> objectsOf(const std::vector<CellIndex>& cells,
                                              const GridWindow& window);

}  // namespace datmo
