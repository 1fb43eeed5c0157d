// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "datmo_fusion/grid/cell_index.h"
#include "datmo_fusion/grid/hit_distribution.h"

namespace datmo {

/// What a map knows about one cell, as saved with the map.
struct CellEvidence {
  CellIndex cell;
  float log_odds = 0.0F;     ///< of being occupied
  float age = 0.0F;          ///< s, between the first and the last hit of its occupant
  std::int32_t refuted = 0;  ///< beam ends here that other sensors refuted
  std::int32_t believed = 0;
  CellHits hits;
};

/// All cells about which a map knows anything.
struct MapEvidence {
  double cell_size = 0.0;  ///< m
  std::vector<CellEvidence> cells;
};

}  // namespace datmo
