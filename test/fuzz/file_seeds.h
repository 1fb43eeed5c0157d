// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo::fuzz {

/// Of the maps in files.
inline OccupancyMapOptions mapOfFiles() {
  OccupancyMapOptions options;
  options.window = {40.0, 40.0, 0.5};
  return options;
}

/// A wall, and free cells before it.
inline MapEvidence wallEvidence() {
  MapEvidence evidence{0.5, {}};
  CellHits hits;
  hits.add({-0.05F, 0.02F}, 50.0F);
  for (int row = -2; row < 2; ++row) {
    evidence.cells.push_back({{8, row}, 3.0F, 2.0F, 1, 7, hits});
    evidence.cells.push_back({{7, row}, -3.0F, 0.0F, 0, 0, {}});
  }
  return evidence;
}

struct FileSeed {
  std::string name;
  unsigned decoder = 0;  ///< index of what reads it, as in fuzz_files.cpp
  std::string bytes;
};

/// A valid file of each kind. Written to a temporary folder on the way.
std::vector<FileSeed> fileSeeds();

}  // namespace datmo::fuzz
