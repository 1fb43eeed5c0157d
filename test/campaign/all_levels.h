// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/ros/stage/stage_graph.h"

namespace datmo::campaign {

/// Fusion of scanner and stereo camera on all levels, with all stages that depend on it.
inline GraphSwitches allLevels() {
  GraphSwitches levels;
  levels.low_level_fusion = levels.road_border = levels.static_points = true;
  levels.stereo_objects = levels.object_fusion = levels.stereo_tracker = true;
  levels.track_fusion = levels.risk = true;
  return levels;
}

}  // namespace datmo::campaign
