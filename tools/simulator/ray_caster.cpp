// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/ray_caster.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/cross.h"

namespace datmo::simulator {

RayCaster::RayCaster(const World& world, const WorldState& state, const Point2& origin,
                     double reach)
    : origin_(origin) {
  addWithin(world.fixedSolids(), reach);
  addWithin(state.moving_solids, reach);
}

void RayCaster::addWithin(const std::vector<Solid>& solids, double reach) {
  for (const Solid& solid : solids) {
    const Circle bound = boundingCircle(solid.outline);
    if ((bound.center - origin_).norm() <= reach + bound.radius) {
      candidates_.push_back({&solid, bound});
    }
  }
}

bool RayCaster::mayMeet(const Candidate& candidate, const Point2& direction) const {
  const Point2 to_center = candidate.bound.center - origin_;
  const double along = to_center.dot(direction);
  const double across = cross(direction, to_center);
  return along >= -candidate.bound.radius && std::abs(across) <= candidate.bound.radius;
}

std::optional<RayHit> RayCaster::nearest(double heading, const HeightBand& band, Surface surface,
                                         double reach) const {
  const HalfLine ray = halfLine(origin_, heading);
  std::optional<RayHit> best;
  for (const Candidate& candidate : candidates_) {
    if (candidate.solid->surface != surface || !mayMeet(candidate, ray.direction)) {
      continue;
    }
    const std::optional<double> range = rangeTo(candidate.solid->outline, ray);
    const double max = best ? best->range : reach;
    if (range && *range <= max && band.lights(candidate.solid->height, *range)) {
      best = RayHit{*range, candidate.solid->object, surface};
    }
  }
  return best;
}

std::vector<Passage> RayCaster::passages(double heading, double reach) const {
  const HalfLine ray = halfLine(origin_, heading);
  std::vector<Passage> found;
  for (const Candidate& candidate : candidates_) {
    if (candidate.solid->surface == Surface::kPaint || !mayMeet(candidate, ray.direction)) {
      continue;
    }
    const std::optional<RaySpan> span = spanAlong(candidate.solid->outline, ray);
    if (span && span->enter > 0.0 && span->enter <= reach) {
      found.push_back({*span, candidate.solid});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const Passage& a, const Passage& b) { return a.span.enter < b.span.enter; });
  return found;
}

}  // namespace datmo::simulator
