// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/passing_objects.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace datmo {

namespace {

/// Adjacent beams end on one surface where it faces them by at least 18 degrees: the step between
/// their end points is at most three times that across them,
constexpr double kMaxSlant = 3.0;

/// and the noise of both ranges, m.
constexpr double kRangeNoise = 0.5;

bool isOnNewObject(const ScanPoint& point) { return point.state == PointState::kMoving; }

bool areOnOneSurface(const ScanPoint& one, const ScanPoint& next, double beam_spacing) {
  return isOnNewObject(one) && isOnNewObject(next) && next.beam <= one.beam + 1 &&
         (next.position - one.position).norm() <=
             kMaxSlant * std::abs(beam_spacing) * one.range + kRangeNoise;
}

}  // namespace

void PassingObjectOptions::visit(OptionVisitor& visitor) {
  visitor.number({"share", "1",
                  "of the end points of beams where the map has seen free space, those of objects "
                  "that pass by; the others are of borders that few beams meet"},
                 share, {0.0, 0.99});
  visitor.number({"detection", "1", "that a beam ends on such an object that it meets"}, detection,
                 {0.01, 0.99});
}

std::vector<double> standingProbabilities(const LabeledScan& scan, double border_detection,
                                          const PassingObjectOptions& options) {
  const std::vector<ScanPoint>& points = scan.points;
  std::vector<double> standing(points.size(), 1.0);
  for (std::size_t first = 0; first < points.size();) {
    std::size_t end = first + 1;
    int beams = 1;
    for (; end < points.size() &&
           areOnOneSurface(points[end - 1], points[end], scan.field.beam_spacing);
         ++end) {
      beams += points[end].beam == points[end - 1].beam ? 0 : 1;  // of several echoes one counts
    }
    if (isOnNewObject(points[first])) {
      const double odds = options.share / (1.0 - options.share) *
                          std::pow(options.detection / border_detection, beams);
      std::fill_n(standing.begin() + static_cast<std::ptrdiff_t>(first), end - first,
                  1.0 / (1.0 + odds));
    }
    first = end;
  }
  return standing;
}

}  // namespace datmo
