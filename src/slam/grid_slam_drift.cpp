// SPDX-License-Identifier: BSD-3-Clause
// What GridSlam knows of the drift of its map.
#include "datmo_fusion/slam/grid_slam.h"

namespace datmo {

namespace {

/// m, of the beams with a hit; 0 without any.
double meanRange(const Scan& scan) {
  double sum = 0.0;
  int hits = 0;
  for (const Ray& ray : scan.rays) {
    sum += ray.hit ? ray.range : 0.0;
    hits += ray.hit ? 1 : 0;
  }
  return hits > 0 ? sum / hits : 0.0;
}

}  // namespace

MapDrift GridSlam::noDrift() const { return {filter_.scalePrior(), options_.map.window.cell_size}; }

void GridSlam::followDrift(const PoseWithCovariance& base_in_map, const Scan& scan,
                           SlamResult& result) {
  drift_.moveTo(base_in_map.pose, result.odometry_used);
  if (result.match.accepted) {
    drift_.write({scan.stamp, filter_.pose(), result.match.surface_age, meanRange(scan)});
  } else {
    drift_.writeUnmatched(filter_.pose().covariance);
  }
  result.drift = drift_.covariance();
}

}  // namespace datmo
