// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/slam/search_region.h"

namespace datmo {

/// A prior map, and the start pose in it.
struct PriorMapOptions {
  std::string file;  ///< empty: build a new map
  bool anywhere = true;
  double x = 0.0;                        ///< m, in the map
  double y = 0.0;                        ///< m
  double heading = 0.0;                  ///< rad
  double position_sigma = 1.0;           ///< m
  double heading_sigma = degrees(10.0);  ///< rad

  void visit(OptionVisitor& visitor);

  SearchRegion start() const;
};

}  // namespace datmo
