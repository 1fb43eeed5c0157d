// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/grid/grid_window.h"

namespace datmo {

/// Groups cells of a window into objects: connected cells, also if they touch only at a corner.
/// `cells`: inside the window, each once. Objects are in the order of their first cells.
std::vector<std::vector<CellIndex>> objectsOf(const std::vector<CellIndex>& cells,
                                              const GridWindow& window);

}  // namespace datmo
