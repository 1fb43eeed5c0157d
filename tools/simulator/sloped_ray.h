// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "simulator/ray_caster.h"

namespace datmo::simulator {

/// A ray with a slope, in the vertical plane through the heading of the passages.
struct SlopedRay {
  double height = 0.0;  ///< m above the road, at the start
  double fall = 0.0;    ///< m per m of distance over ground; negative: it climbs
  double reach = 0.0;   ///< m over ground
};

/// The end point of a ray.
struct RayEnd {
  double range = 0.0;            ///< m over ground
  double height = 0.0;           ///< m above the road
  const Solid* solid = nullptr;  ///< none: the road
};

/// The first face, top or piece of flat road that the line hits; none: the sky, or too far. Exact
/// for upright prisms. `passages`: as RayCaster::passages gives them.
std::optional<RayEnd> endOf(const SlopedRay& line, const std::vector<Passage>& passages);

}  // namespace datmo::simulator
