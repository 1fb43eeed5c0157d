// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dent_splitter.h"
#include "stereo_surfaces.h"

namespace datmo {

/// Groups surfaces that belong together: adjacent at the same depth, within its noise, with nothing
/// farther away seen between them; or one seen above the other and slightly behind it, such as a
/// windshield above a hood. Surfaces of very different height are separated, such as a pedestrian
/// next to a pole, as are those beyond a dent (DentSplitter). Groups are ordered by their first
/// surfaces.
std::vector<SurfaceGroup> groupSurfaces(const SurfaceColumns& columns, const StereoCamera& camera,
                                        const SurfaceGroupOptions& options);

}  // namespace datmo
