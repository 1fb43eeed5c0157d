// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/static_scan.h"

#include <algorithm>
#include <limits>

namespace datmo {

namespace {

constexpr float kNoReturn = std::numeric_limits<float>::infinity();
constexpr float kNothingKnown = std::numeric_limits<float>::quiet_NaN();

bool stands(const ScanPoint& point, bool include_unknown) {
  return point.state == PointState::kStatic ||
         (include_unknown && point.state == PointState::kUnknown);
}

}  // namespace

double staticRange(const ScanField& field) {
  return field.free_range > 0.0 ? std::min(field.free_range, field.range) : field.range;
}

std::vector<float> staticRanges(const LabeledScan& scan, bool include_unknown) {
  const float without_return = scan.field.free_range > 0.0 ? kNoReturn : kNothingKnown;
  std::vector<float> ranges(scan.field.beams, without_return);
  for (const std::uint32_t beam : scan.blind_beams) {
    if (beam < ranges.size()) {
      ranges[beam] = kNothingKnown;
    }
  }
  // Of several end points of a beam, the nearest is what it meets first.
  std::vector<double> nearest(ranges.size(), std::numeric_limits<double>::infinity());
  for (const ScanPoint& point : scan.points) {
    if (point.beam < ranges.size() && point.range < nearest[point.beam]) {
      nearest[point.beam] = point.range;
      const bool is_known = point.range <= staticRange(scan.field);
      ranges[point.beam] = is_known && stands(point, include_unknown)
                               ? static_cast<float>(point.range)
                               : kNothingKnown;
    }
  }
  return ranges;
}

std::vector<Point2> staticPoints(const LabeledScan& scan, bool include_unknown) {
  std::vector<Point2> points;
  for (const ScanPoint& point : scan.points) {
    if (stands(point, include_unknown)) {
      points.push_back(point.position);
    }
  }
  return points;
}

}  // namespace datmo
