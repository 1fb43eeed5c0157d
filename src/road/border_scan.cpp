// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_scan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace datmo {

BorderScan borderScan(const LabeledScan& scan, const HitGrid& hits, double seconds) {
  const Pose2& vehicle = scan.base_in_map.pose;
  BorderScan result;
  result.scanner = vehicle * scan.scanner_in_base;
  result.seconds = seconds;
  result.beams.reserve(scan.field.beams);
  const auto addHit = [&](const ScanPoint& point) {
    const Point2 end = vehicle * point.position;
    const CellIndex cell = hits.window().cellAt(end);
    result.beams.push_back({end, true, hits.smoothed(cell), hits.isLasting(cell)});
  };
  auto point = scan.points.begin();
  auto blind = scan.blind_beams.begin();
  for (std::uint32_t beam = 0; beam < scan.field.beams; ++beam) {
    while (blind != scan.blind_beams.end() && *blind < beam) {
      ++blind;
    }
    bool hit = false;
    for (; point != scan.points.end() && point->beam <= beam; ++point) {
      addHit(*point);
      hit = true;
    }
    const bool is_blind = blind != scan.blind_beams.end() && *blind == beam;
    if (!hit && !is_blind && scan.field.free_range > 0.0) {
      const double bearing = scan.field.first_bearing + beam * scan.field.beam_spacing;
      const Point2 end(scan.field.free_range * std::cos(bearing),
                       scan.field.free_range * std::sin(bearing));
      result.beams.push_back({result.scanner * end, false, 0, false});
    }
  }
  // If the scan's field of view is unknown, all of them.
  std::for_each(point, scan.points.end(), addHit);
  return result;
}

}  // namespace datmo
