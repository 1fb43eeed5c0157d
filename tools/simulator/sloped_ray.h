// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "simulator/ray_caster.h"

namespace datmo::simulator {

/// A ray that sinks or climbs in the upright plane through the heading of some passages.
struct SlopedRay {
  double height = 0.0;  ///< m above the road, at the start
  double fall = 0.0;    ///< m per m of distance over ground; negative: it climbs
  double reach = 0.0;   ///< m over ground
};

/// What a ray ends on.
struct RayEnd {
  double range = 0.0;            ///< m over ground
  double height = 0.0;           ///< m above the road
  const Solid* solid = nullptr;  ///< none: the road
};

/// The first face, top or piece of flat road that the line meets; nothing: the sky, or too far.
/// Exact for upright prisms. `passages`: as RayCaster::passages gives them.
std::optional<RayEnd> endOf(const SlopedRay& line, const std::vector<Passage>& passages);

}  // namespace datmo::simulator
