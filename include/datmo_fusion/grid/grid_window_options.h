// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/grid/grid_window.h"

namespace datmo {

/// Extent and resolution of a grid around the vehicle. Grids to be fused with each other must have
/// the same.
struct GridWindowOptions {
  double length = 90.0;    ///< m, along x
  double width = 108.0;    ///< m, along y
  double cell_size = 0.3;  ///< m

  void visit(OptionVisitor& visitor);

  /// Returns the window with the frame's origin in its middle cell. Throws OptionError, also if it
  /// has more cells than fit in memory.
  GridWindow window() const;
};

}  // namespace datmo
