// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/slam/grid_slam.h"

namespace datmo {

/// Returns whether a vehicle can have this state: the file's checksum shows only that it was not
/// damaged, not who wrote it.
bool isSound(const SlamState& slam);

}  // namespace datmo
