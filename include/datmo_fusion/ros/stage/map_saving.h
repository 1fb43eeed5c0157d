// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include <datmo_fusion/SaveMap.h>

#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Writes a map (writeMap). Returns a sentence about what was written. Throws MapFileError.
std::string savedMapText(const std::string& file, const OccupancyMap& map);

/// Returns the response of a service save_map: `save` writes to an absolute path, returns a
/// sentence about what was written, and throws on failure. Errors are returned in the response and
/// as a warning of the monitor.
datmo_fusion::SaveMap::Response answerSaveMap(
    const datmo_fusion::SaveMap::Request& request, StageMonitor& monitor,
    const std::function<std::string(const std::string& file)>& save);

}  // namespace datmo
