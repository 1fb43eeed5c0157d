// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/road_model.h"

namespace datmo {

const char* nameOf(RoadSide side) { return side == RoadSide::kLeft ? "left" : "right"; }

}  // namespace datmo
