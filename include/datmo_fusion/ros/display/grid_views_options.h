// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// Which grids GridViews draws, how much of them and how large.
struct GridViewsOptions {
  std::string panels = "lidar stereo fused conflict map";
  double ahead = 40.0;            ///< m
  double behind = 5.0;            ///< m
  double to_side = 20.0;          ///< m
  double pixels_per_meter = 8.0;  ///< px/m
  double rate = 5.0;              ///< Hz
  double silent_after = 1.0;      ///< s

  void visit(OptionVisitor& visitor);

  /// Names of the panels from left to right. Throws OptionError if there are none, for a duplicate,
  /// and for one that cannot be a topic name.
  std::vector<std::string> panelNames() const;
};

}  // namespace datmo
