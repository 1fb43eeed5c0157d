#pragma once

#include <cstddef>
#include <vector>

#include "stereo_surfaces.h"

namespace datmo {

/// Indices of surfaces that belong together, by column.
using SurfaceGroup = std::vector<std::size_t>;

/// Surfaces beside each other at the same depth, as far as its noise tells, and not of very
/// different height: a car before a house, a pedestrian beside a pole. Groups by their first
/// surfaces.
std::vector<SurfaceGroup> groupSurfaces(const SurfaceColumns& columns, const StereoCamera& camera,
                                        const SurfaceGroupOptions& options);

}  // namespace datmo
