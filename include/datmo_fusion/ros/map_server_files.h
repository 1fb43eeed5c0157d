// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo {

/// The two files of a map of map_server, as text.
struct MapServerFiles {
  std::string yaml;
  std::string image;  ///< PGM
};

/// `image_name`: as the yaml file names the image. All that the map knows: occupied (0), free
/// (254), unknown (205).
MapServerFiles toMapServerFiles(OccupancyMap map, const std::string& image_name);

/// Evidence that is as sure as the options let it be, where a map of map_server says occupied or
/// free; pixels are hits of the cells in which their centers lie. `file`: its yaml file. Throws
/// MapFileError: unreadable, no binary PGM image (P5, of 8 bits), pixels larger than cells.
MapEvidence readMapServerFiles(const std::string& file, const OccupancyMapOptions& options);

}  // namespace datmo
