// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo {

/// The two files of a map_server map, as text.
struct MapServerFiles {
  std::string yaml;
  std::string image;       ///< PGM
  int cells_of_pixel = 1;  ///< along each side of a pixel
};

/// `evidence`: of the whole map. `image_name`: name of the image in the yaml file. Pixels: occupied
/// (0), free (254), unknown (205). A pixel is one cell, or several if the image would be too large:
/// then it is occupied if any of them is, and free if any is free and none occupied.
MapServerFiles toMapServerFiles(const OccupancyMap& map, const MapEvidence& evidence,
                                const std::string& image_name);

/// Returns evidence with the maximum certainty of the options for occupied and free pixels of a
/// map_server map; each pixel counts for the cell that contains its center. `file`: its yaml file.
/// Throws MapFileError: unreadable, not a binary PGM image (P5, 8 bits), pixels larger than cells.
MapEvidence readMapServerFiles(const std::string& file, const OccupancyMapOptions& options);

}  // namespace datmo
