// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cells_in_view.h"

#include "datmo_fusion/grid/sensor_grid.h"
#include "datmo_fusion/sensor_model/stereo_grid.h"

namespace datmo {

/// Counts of the points of one cloud.
struct StereoCounts {
  std::size_t points = 0;    ///< finite and in front of the camera
  std::size_t in_layer = 0;  ///< of these, in the layer of obstacles and within range
};

/// The method `cones` of StereoGridModel, as in the thesis (eq. 3.2.2 to 3.2.4). `grid`: with all
/// cells unknown; heights are above the road of `view`.
StereoCounts fillByCones(const StereoGridOptions& options, const StereoCloud& cloud,
                         const StereoView& view, const ViewSector& field, SensorGrid& grid);

}  // namespace datmo
