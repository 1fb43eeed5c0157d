// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "yard.h"

#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/slam/loop_closer.h"

namespace datmo {

/// The scan of a world from a pose.
using ScannedWorld = std::function<Scan(const Pose2& base, double seconds)>;

/// All end points of a scan are static.
inline LabeledScan labeled(const Scan& scan, const Pose2& base_in_map) {
  LabeledScan labeled;
  labeled.stamp = scan.stamp;
  labeled.base_in_map.pose = base_in_map;
  labeled.scanner_in_base = scan.scanner_in_base;
  labeled.field = scan.field;
  for (const Ray& ray : scan.rays) {
    if (ray.hit) {
      labeled.points.push_back({ray.end, ray.range, ray.bearing, ray.beam, PointState::kStatic});
    }
  }
  return labeled;
}

inline Keyframe keyframe(const ScannedWorld& world, const Pose2& truth, const Pose2& base_in_map,
                         double seconds) {
  const LabeledScan scan = labeled(world(truth, seconds), base_in_map);
  return {scan.stamp, scan.base_in_map, KeptScan(scan)};
}

/// A motion as measured by a drifting live SLAM.
inline Pose2 drifting(const Pose2& motion) {
  return {1.01 * motion.x(), 1.01 * motion.y(), motion.heading() + degrees(0.04) * motion.x()};
}

/// Around a rectangle of 28 m x 8 m in the yard, 1 m from one pose to the next.
inline std::vector<Pose2> roundTheYard(int laps) {
  std::vector<Pose2> poses{Pose2(0.0, -4.0, 0.0)};
  for (int side = 0; side < 4 * laps; ++side) {
    const int meters = side % 2 == 0 ? 28 : 8;
    for (int i = 0; i < meters; ++i) {
      poses.push_back(poses.back() * Pose2(1.0, 0.0, 0.0));
    }
    for (int i = 0; i < 3; ++i) {
      poses.push_back(poses.back() * Pose2(0.0, 0.0, degrees(30.0)));
    }
  }
  return poses;
}

/// The options for an area of this size.
inline LoopCloserOptions yardOptions() {
  LoopCloserOptions options;
  options.submap_length = 10.0;
  options.search_distance = 2.0;
  options.min_loop = 40.0;
  options.max_distance = 4.0;
  return options;
}

}  // namespace datmo
