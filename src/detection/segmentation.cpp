// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/segmentation.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

double gapBetween(const ScanPoint& first, const ScanPoint& second,
                  const SegmentationOptions& options) {
  if (!options.adaptive) {
    return options.max_gap;
  }
  const double angle = std::abs(angleBetween(first.bearing, second.bearing));
  if (angle >= options.min_incidence) {
    return options.max_gap;
  }
  const double range = std::min(first.range, second.range);
  const double reach = range * std::sin(angle) / std::sin(options.min_incidence - angle);
  return std::min(options.min_gap + reach, options.max_gap);
}

}  // namespace

void SegmentationOptions::visit(OptionVisitor& visitor) {
  visitor.number({"max_gap", "m", "points farther apart belong to two objects (thesis 3.3.1: 2 m)",
                  Tier::kPublic},
                 max_gap, {0.05, 20.0});
  visitor.number(
      {"min_gap", "m", "adaptive: points closer than this belong to one object at any range",
       Tier::kPublic},
      min_gap, {0.0, 20.0});
  visitor.toggle({"adaptive", "",
                  "the gap grows with range and beam spacing (Borges & Aldon 2004); false: max_gap "
                  "everywhere (thesis)"},
                 adaptive);
  visitor.number(
      {"min_incidence", "rad",
       "adaptive: smallest angle between a beam and a surface that is kept in one piece"},
      min_incidence, {0.05, 1.5});
}

std::vector<Segment> segmentPoints(const std::vector<ScanPoint>& points,
                                   const SegmentationOptions& options) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool joins = i > 0 && (points[i].position - points[i - 1].position).norm() <
                                    gapBetween(points[i - 1], points[i], options);
    if (!joins) {
      segments.emplace_back();
    }
    segments.back().push_back(i);
  }
  return segments;
}

}  // namespace datmo
