// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/map_saving.h"

#include <exception>
#include <filesystem>

#include "datmo_fusion/ros/map_files.h"

namespace datmo {

std::string savedMapText(const std::string& file, const OccupancyMap& map) {
  const SavedMap saved = writeMap(file, map);
  std::string text = file + ": " + std::to_string(saved.cells) + " cells";
  if (saved.cells_of_pixel > 1) {
    const std::string side = std::to_string(saved.cells_of_pixel);
    text +=
        "; its image would be too large, so each pixel covers " + side + " x " + side + " cells";
  }
  if (!saved.tile_file_error.empty()) {
    text += "; tiles are missing (" + std::to_string(saved.forgotten_tiles) +
            " were forgotten): there are more than map/max_tiles, and " + saved.tile_file_error;
  }
  return text;
}

datmo_fusion::SaveMap::Response answerSaveMap(
    const datmo_fusion::SaveMap::Request& request, StageMonitor& monitor,
    const std::function<std::string(const std::string& file)>& save) {
  datmo_fusion::SaveMap::Response response;
  response.success = false;
  if (!std::filesystem::path(request.file).is_absolute()) {
    response.message = "file '" + request.file + "': expected an absolute path";
    return response;
  }
  try {
    response.message = save(request.file);
    response.success = true;
  } catch (const std::exception& error) {  // out of memory, too
    response.message = error.what();
    monitor.warned(InputError("map_not_saved", error.what()));
  }
  return response;
}

}  // namespace datmo
