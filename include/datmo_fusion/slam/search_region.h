// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/grid/grid_window.h"

namespace datmo {

/// Where a vehicle may be in a map.
struct SearchRegion {
  PoseWithCovariance prior;  ///< its covariance positive definite; not read with `anywhere`
  bool anywhere = false;     ///< in all of the map's window, at any heading
};

/// The region's prior; of all of a window, mean and covariance of a pose that may be any in it.
PoseWithCovariance priorOf(const SearchRegion& region, const GridWindow& window);

}  // namespace datmo
