// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "yard.h"

namespace datmo {

/// Two endless walls 10 m apart, optionally with a pillar in front of one of them every 7 m.
inline Scan betweenWalls(const Pose2& base, double seconds, bool with_pillars) {
  Scan scan = Yard().scan(base, seconds);
  const Pose2 scanner = base * scan.scanner_in_base;
  for (Ray& ray : scan.rays) {
    const double direction = scanner.heading() + ray.bearing;
    ray.range = 45.0;
    ray.hit = false;
    for (double range = 0.5; range < 45.0 && !ray.hit; range += 0.05) {
      const Point2 at =
          scanner.position() + range * Point2(std::cos(direction), std::sin(direction));
      const double along = at.x() - 7.0 * std::floor(at.x() / 7.0);
      const bool pillar = with_pillars && along < 2.0 && at.y() > 3.5;
      ray.hit = std::abs(at.y()) > 5.0 || pillar;
      ray.range = ray.hit ? range : ray.range;
    }
    ray.end = scan.scanner_in_base *
              Point2(ray.range * std::cos(ray.bearing), ray.range * std::sin(ray.bearing));
  }
  return scan;
}

}  // namespace datmo
