// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dent_splitter.h"
#include "stereo_surfaces.h"

namespace datmo {

/// Surfaces that belong together: beside each other at the same depth, within its noise,
/// with nothing farther away seen between them; or one seen above the other and little behind it,
/// as a windscreen over a bonnet. What is very different in height is apart, as a pedestrian beside
/// a pole, and so is what is beyond a dent (DentSplitter). Groups by their first surfaces.
std::vector<SurfaceGroup> groupSurfaces(const SurfaceColumns& columns, const StereoCamera& camera,
                                        const SurfaceGroupOptions& options);

}  // namespace datmo
