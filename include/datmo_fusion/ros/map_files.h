// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/ros/map_format.h"

namespace datmo {

/// Result of writing a map.
struct SavedMap {
  std::size_t cells = 0;             ///< known cells
  int cells_of_pixel = 1;            ///< along each side of a pixel of the image
  std::size_t forgotten_tiles = 0;   ///< that did not fit in the map: OccupancyMapOptions
  std::string tile_file_error = {};  ///< why their file could not be written; empty: no error
};

/// Names of the files written beside a map.
struct MapServerNames {
  std::string yaml;
  std::string image;
};
MapServerNames mapServerNames(const std::string& file);

/// Writes a map: `file` with all evidence, and beside it a yaml file and an image for map_server
/// (mapServerNames). Each file appears only when complete, and an existing one is kept until then.
/// Throws MapFileError: a name that ends in .yaml or .pgm, an existing yaml file that is not a
/// map's, a directory, missing permissions, a full disk. If an image with one pixel per cell would
/// be too large, it has larger pixels; `file` has all cells.
SavedMap writeMap(const std::string& file, const OccupancyMap& map);

/// Reads a file written by writeMap, or a yaml file of map_server (its name ends in .yaml or .yml),
/// with the cell size in the options; completely, regardless of `max_tiles`. Throws MapFileError:
/// no such file, a truncated or corrupt file, another cell size.
OccupancyMap readMap(const std::string& file, const Checked<OccupancyMapOptions>& options);

}  // namespace datmo
