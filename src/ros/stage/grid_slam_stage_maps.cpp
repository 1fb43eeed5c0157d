// SPDX-License-Identifier: BSD-3-Clause
// What GridSlamStage does with map files.
#include <filesystem>

#include "datmo_fusion/ros/stage/grid_slam_stage.h"

namespace datmo {

void GridSlamStage::readPriorMap() {
  const std::string& file = options_.prior_map.file;
  if (file.empty()) {
    return;
  }
  try {
    slam_.startIn({readMap(file, options_.slam.map), options_.prior_map.start()});
  } catch (const MapFileError& error) {
    throw OptionError(std::string("prior_map/file: ") + error.what());
  } catch (const std::invalid_argument& error) {
    throw OptionError("prior_map/file: " + file + ": " + error.what());
  }
}

std::string GridSlamStage::saveMap(const std::string& file) const {
  const SavedMap saved = writeMap(file, slam_.lastingMap());
  std::string text = file + ": " + std::to_string(saved.cells) + " cells";
  if (saved.forgotten_tiles > 0) {
    text += "; " + std::to_string(saved.forgotten_tiles) +
            " tiles were forgotten before, since there are more than map/max_tiles";
  }
  return text;
}

/// Whether saving there would replace a file of the prior map.
bool GridSlamStage::isOfPriorMap(const std::string& file) const {
  const std::string& prior = options_.prior_map.file;
  return !prior.empty() && mapServerNames(file).yaml == mapServerNames(prior).yaml;
}

datmo_fusion::SaveMap::Response GridSlamStage::answer(
    const datmo_fusion::SaveMap::Request& request) const {
  datmo_fusion::SaveMap::Response response;
  response.success = false;
  if (!std::filesystem::path(request.file).is_absolute()) {
    response.message = "file '" + request.file + "': expected an absolute path";
    return response;
  }
  try {
    if (isOfPriorMap(request.file)) {
      throw MapFileError(request.file + ": the map in use, expected another name");
    }
    response.message = saveMap(request.file);
    response.success = true;
  } catch (const std::exception& error) {  // no memory, too
    response.message = error.what();
    monitor_.warned(InputError("map_not_saved", error.what()));
  }
  return response;
}

}  // namespace datmo
