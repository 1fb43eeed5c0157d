// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/scan.h"

namespace datmo::samples {

/// A scan from the base frame's origin: 81 beams, 2 degrees apart, to both sides of x, known free
/// up to 40 m. The beams nearest to the points (m, map frame) end there; the vehicle is at
/// `base_in_map`, `seconds` after the start.
inline LabeledScan scanOf(const std::vector<Point2>& positions, double seconds,
                          const Pose2& base_in_map = {}) {
  LabeledScan scan;
  scan.stamp = Stamp::fromSeconds(100.0 + seconds);
  scan.base_in_map.pose = base_in_map;
  scan.field.beams = 81;
  scan.field.beam_spacing = kPi / 90.0;
  scan.field.first_bearing = -40.0 * scan.field.beam_spacing;
  scan.field.free_range = 40.0;
  scan.field.range = 50.0;
  for (const Point2& position : positions) {
    const Point2 seen = base_in_map.inverse() * position;
    ScanPoint point;
    point.position = seen;
    point.range = seen.norm();
    point.bearing = std::atan2(seen.y(), seen.x());
    point.beam = static_cast<std::uint32_t>(
        std::lround((point.bearing - scan.field.first_bearing) / scan.field.beam_spacing));
    scan.points.push_back(point);
  }
  return scan;
}

}  // namespace datmo::samples
