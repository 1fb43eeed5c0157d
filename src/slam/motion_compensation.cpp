// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/motion_compensation.h"

#include <algorithm>

namespace datmo {

double sweepDuration(const Scan& scan) {
  double duration = 0.0;
  for (const Ray& ray : scan.rays) {
    duration = std::max(duration, ray.time);
  }
  return duration;
}

Scan compensateMotion(Scan scan, const Twist2& twist) {
  if (!scan.rays.empty() && scan.rays.back().beam > 0) {
    const Ray& last = scan.rays.back();
    scan.field.beam_spacing += twist.yaw_rate * last.time / last.beam;
  }
  for (Ray& ray : scan.rays) {
    if (ray.time == 0.0) {
      continue;
    }
    const Pose2 base_then = arc(twist, ray.time);
    ray.origin = base_then * ray.origin;
    ray.end = base_then * ray.end;
    ray.bearing = normalizeAngle(ray.bearing + base_then.heading());
    ray.time = 0.0;
  }
  return scan;
}

Scan scanAt(Scan scan, Stamp stamp, const Pose2& base) {
  scan.stamp = stamp;
  scan.scanner_in_base = base * scan.scanner_in_base;
  for (Ray& ray : scan.rays) {
    ray.origin = base * ray.origin;
    ray.end = base * ray.end;
  }
  return scan;
}

}  // namespace datmo
