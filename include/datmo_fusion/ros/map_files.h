// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo {

/// A map file that cannot be read or written: the message names it and says what is wrong, and what
/// was expected.
class MapFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What of a file has been written.
struct SavedMap {
  std::size_t cells = 0;             ///< of which anything is known
  int cells_of_pixel = 1;            ///< along each side of a pixel of the image
  std::size_t forgotten_tiles = 0;   ///< that the map had no room for: OccupancyMapOptions
  std::string tile_file_error = {};  ///< what failed of their file; empty: nothing is missing
};

/// What is written beside a map.
struct MapServerNames {
  std::string yaml;
  std::string image;
};
MapServerNames mapServerNames(const std::string& file);

/// Writes a map: `file` with all evidence, and beside it a yaml file and an image as map_server has
/// them (mapServerNames). Each appears when it is complete, and what stood there before stays until
/// then. Throws MapFileError: a name that ends in .yaml or .pgm, a yaml file beside it that is of
/// no map, a folder, no rights, a full disk. Where an image with a pixel for each cell would be too
/// large, its pixels are larger, and `file` has all cells.
SavedMap writeMap(const std::string& file, const OccupancyMap& map);

/// The map of a file that writeMap has written, or of a yaml file of map_server (its name ends in
/// .yaml or .yml), of cells of the size that the options say; all of it, whatever `max_tiles` is.
/// Throws MapFileError: no such file, a file that is cut or changed, cells of another size.
OccupancyMap readMap(const std::string& file, const Checked<OccupancyMapOptions>& options);

}  // namespace datmo
