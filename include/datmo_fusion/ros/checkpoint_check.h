// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/slam/grid_slam.h"

namespace datmo {

/// Returns whether a vehicle can have this state: its checksum only shows that a file is as it was
/// written, not by whom.
bool isSound(const SlamState& slam);

}  // namespace datmo
