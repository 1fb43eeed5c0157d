// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/grid/grid_window.h"

namespace datmo {

/// Where a vehicle may be in a map.
struct SearchRegion {
  PoseWithCovariance prior;  ///< covariance positive definite; unused with `anywhere`
  bool anywhere = false;     ///< in the map's whole window, at any heading
};

/// Returns the region's prior; with `anywhere`, mean and covariance of a uniform pose in the
/// window.
PoseWithCovariance priorOf(const SearchRegion& region, const GridWindow& window);

}  // namespace datmo
