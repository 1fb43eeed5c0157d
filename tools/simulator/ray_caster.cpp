#include "simulator/ray_caster.h"

#include <cmath>

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
    if ((bound.centre - origin_).norm() <= reach + bound.radius) {
      candidates_.push_back({&solid, bound});
    }
  }
}

std::optional<RayHit> RayCaster::nearest(double heading, const HeightBand& band, Surface surface,
                                         double reach) const {
  const HalfLine ray = halfLine(origin_, heading);
  std::optional<RayHit> best;
  for (const Candidate& candidate : candidates_) {
    const Point2 to_centre = candidate.bound.centre - origin_;
    const double along = to_centre.dot(ray.direction);
    const double across = ray.direction.x() * to_centre.y() - ray.direction.y() * to_centre.x();
    if (candidate.solid->surface != surface || along < -candidate.bound.radius ||
        std::abs(across) > candidate.bound.radius) {
      continue;
    }
    const std::optional<double> range = rangeTo(candidate.solid->outline, ray);
    const double most = best ? best->range : reach;
    if (range && *range <= most && band.lights(candidate.solid->height, *range)) {
      best = RayHit{*range, candidate.solid->object};
    }
  }
  return best;
}

}  // namespace datmo::simulator
