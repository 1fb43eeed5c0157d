// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cells_in_view.h"

#include "datmo_fusion/grid/sensor_grid.h"
#include "datmo_fusion/sensor_model/stereo_grid.h"

namespace datmo {

/// What a grid of counts led to.
struct StereoCounts {
  std::size_t points = 0;    ///< those that are finite and in front of the camera
  std::size_t in_layer = 0;  ///< of these, in the layer of obstacles and within range
};

/// The thesis's plain form, eq. 3.2.2 to 3.2.4: the method `cones` of StereoGridModel. `grid`: with
/// all cells unknown; heights from the road of `view`.
StereoCounts fillByCones(const StereoGridOptions& options, const StereoCloud& cloud,
                         const StereoView& view, const FieldOfView& field, SensorGrid& grid);

}  // namespace datmo
