// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/map_files.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "datmo_fusion/ros/map_server_files.h"
#include "datmo_fusion/ros/whole_file.h"

namespace datmo {

namespace {

/// m; cell sizes that differ by less are equal.
constexpr double kSameCellSize = 1e-9;

MapEvidence readOwn(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw MapFileError(file + ": cannot be opened, expected permission to read it");
  }
  return readMapText(in, file);
}

bool isMapServers(const std::filesystem::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

/// Whether writing a yaml file of map_server there would overwrite nothing else.
bool isAbsentOrMapServers(const std::string& yaml) {
  std::error_code unusable;
  if (!std::filesystem::exists(yaml, unusable)) {
    return true;
  }
  std::string first;
  std::ifstream(yaml) >> first;
  return first == "image:";
}

}  // namespace

MapServerNames mapServerNames(const std::string& file) {
  const std::filesystem::path path(file);
  return {std::filesystem::path(path).replace_extension(".yaml").string(),
          std::filesystem::path(path).replace_extension(".pgm").string()};
}

SavedMap writeMap(const std::string& file, const OccupancyMap& map) {
  const std::filesystem::path path(file);
  if (isMapServers(path) || path.extension() == ".pgm") {
    throw MapFileError(file +
                       ": expected a name for the map itself; the files of map_server are "
                       "written beside it, as .yaml and .pgm");
  }
  const MapEvidence evidence = map.evidence();
  const auto [yaml, image] = mapServerNames(file);
  if (!isAbsentOrMapServers(yaml)) {
    throw MapFileError(file + ": " + yaml +
                       " would be written beside it, but exists and does not belong to a map: "
                       "expected another name");
  }
  try {
    checkWritable(file);
    MapServerFiles files =
        toMapServerFiles(map, evidence, std::filesystem::path(image).filename().string());
    std::vector<NamedText> texts;  // filled later: an initializer list would copy the texts
    texts.push_back({image, std::move(files.image)});
    texts.push_back({yaml, std::move(files.yaml)});
    texts.push_back({file, mapText(evidence)});
    writeWholeFiles(texts);
    return {evidence.cells.size(), files.cells_of_pixel, map.forgottenTiles(), map.tileFileError()};
  } catch (const std::runtime_error& error) {
    throw MapFileError(error.what());
  }
}

OccupancyMap readMap(const std::string& file, const Checked<OccupancyMapOptions>& options) {
  std::error_code unusable;
  if (!std::filesystem::is_regular_file(file, unusable)) {
    throw MapFileError(file +
                       ": no such file, expected the absolute path of a saved map or of a yaml "
                       "file of map_server");
  }
  const MapEvidence evidence =
      isMapServers(file) ? readMapServerFiles(file, *options) : readOwn(file);
  if (std::abs(evidence.cell_size - options->window.cell_size) > kSameCellSize) {
    throw MapFileError(file + ": cells of " + toText(OptionValue(evidence.cell_size)) +
                       " m, expected " + toText(OptionValue(options->window.cell_size)) +
                       " m (grid_slam's map/cell_size)");
  }
  if (evidence.cells.empty()) {
    throw MapFileError(file + ": has only unknown cells, expected occupied and free ones");
  }
  return OccupancyMap::restored(options, evidence);
}

}  // namespace datmo
