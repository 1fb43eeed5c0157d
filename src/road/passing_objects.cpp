// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/passing_objects.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace datmo {

namespace {

/// Step between the end points of adjacent beams on one surface over the distance of the beams
/// there: of a surface that they meet at 19 degrees.
constexpr double kMaxSlant = 3.0;

/// Allowance for the noise of both ranges, m.
constexpr double kRangeNoise = 0.5;

bool isOnNewObject(const ScanPoint& point) { return point.state == PointState::kMoving; }

bool areOnOneSurface(const ScanPoint& one, const ScanPoint& next, double beam_spacing) {
  return isOnNewObject(one) && isOnNewObject(next) &&
         (next.beam == one.beam || next.beam == one.beam + 1) &&
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
      const double log_odds = std::log(options.share / (1.0 - options.share)) +
                              beams * std::log(options.detection / border_detection);
      std::fill_n(standing.begin() + static_cast<std::ptrdiff_t>(first), end - first,
                  1.0 / (1.0 + std::exp(log_odds)));
    }
    first = end;
  }
  return standing;
}

}  // namespace datmo
