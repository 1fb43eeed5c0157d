// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo::samples {

inline OccupancyMapOptions smallMap() {
  OccupancyMapOptions options;
  options.window.length = 20.0;
  options.window.width = 20.0;
  options.window.cell_size = 1.0;
  return options;
}

/// Beams from the origin of the base frame to these ends.
inline Scan scanTo(const std::vector<Point2>& ends, double seconds = 0.0, bool hit = true) {
  Scan scan;
  scan.stamp = Stamp::fromSeconds(100.0 + seconds);
  scan.field.beam_spacing = degrees(2.0);
  for (const Point2& end : ends) {
    Ray ray;
    ray.end = end;
    ray.range = end.norm();
    ray.bearing = std::atan2(end.y(), end.x());
    ray.hit = hit;
    scan.rays.push_back(ray);
  }
  return scan;
}

/// The same with another angle between the beams, rad.
inline Scan scanWithSpacing(double beam_spacing, const std::vector<Point2>& ends) {
  Scan scan = scanTo(ends);
  scan.field.beam_spacing = beam_spacing;
  return scan;
}

inline void updateWith(OccupancyMap& map, const Scan& scan, PointState state = PointState::kUnknown,
                       const Pose2& pose = {}) {
  map.update(scan, std::vector<PointState>(scan.rays.size(), state), pose);
}

/// A map of 10 m x 10 m in cells of 1 m around the origin, with a beam along x through the row
/// above the x axis that ends in the cell of x = 4.5 m, three times in 2 s.
inline OccupancyMap mapWithABeam() {
  OccupancyMapOptions options;
  options.window = {10.0, 10.0, 1.0};
  OccupancyMap map(options);
  for (int i = 0; i < 3; ++i) {
    Scan scan = scanTo({Point2(4.5, 0.5)}, i);
    scan.rays[0].origin = Point2(-4.5, 0.5);
    scan.rays[0].range = 9.0;
    updateWith(map, scan);
  }
  return map;
}

}  // namespace datmo::samples
