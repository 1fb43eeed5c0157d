// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/road_scene.h"

#include <algorithm>

namespace datmo {

namespace {

/// Points up to this many standard deviations beyond the effective range still belong to it.
constexpr double kBeyondRange = 2.0;

}  // namespace

void RoadSceneOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"effective_range", "m",
       "range beyond which the camera's depth is not used (thesis 3.2.2 and 3.3.3: 36 m)",
       Tier::kPublic},
      effective_range, {1.0, 200.0});
  visitor.group("road", [&] { road.visit(visitor); });
}

double RoadSceneOptions::maxDepth(const StereoCamera& camera) const {
  return std::min(2.0 * effective_range,
                  effective_range + kBeyondRange * camera.depthSigma(effective_range));
}

}  // namespace datmo
