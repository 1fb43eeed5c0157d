// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo {

/// The two files of a map of map_server, as text.
struct MapServerFiles {
  std::string yaml;
  std::string image;       ///< PGM
  int cells_of_pixel = 1;  ///< along each side of a pixel
};

/// `evidence`: all of the map's. `image_name`: as the yaml file names the image: occupied (0), free
/// (254), unknown (205). A pixel is a cell, or several where the image would be too large: then it
/// is occupied if one of them is, and free if one is and none is occupied.
MapServerFiles toMapServerFiles(const OccupancyMap& map, const MapEvidence& evidence,
                                const std::string& image_name);

/// Evidence that is as sure as the options let it be, where a map of map_server says occupied or
/// free; pixels are hits of the cells in which their centers lie. `file`: its yaml file. Throws
/// MapFileError: unreadable, no binary PGM image (P5, of 8 bits), pixels larger than cells.
MapEvidence readMapServerFiles(const std::string& file, const OccupancyMapOptions& options);

}  // namespace datmo
