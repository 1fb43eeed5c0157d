// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/end_points.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "datmo_fusion/common/uniform.h"

namespace datmo {

namespace {

/// The end point of a beam, and what it is compared with its neighbors by.
struct End {
  Point2 position;
  double range;
  Point2 across;  ///< from this beam to the next one at this range, m
};

/// Step along the surface that the beam hit, from its neighbors: the mean of the steps to those
/// nearer than `max_step`. If neither is, the surface is hit at a grazing angle, and the shorter
/// step gives its direction; but an end point in front of both is a separate object: none.
std::optional<Point2> stepAlongSurface(const End* previous, const End& end, const End* next,
                                       double max_step) {
  Point2 sum = Point2::Zero();
  int steps = 0;
  std::optional<Point2> shortest;
  bool stands_out = true;
  for (const End* neighbor : {previous, next}) {
    if (neighbor == nullptr) {
      continue;
    }
    const double sign = neighbor == next ? 1.0 : -1.0;
    const Point2 step = sign * (neighbor->position - end.position);
    if (step.norm() < max_step) {
      sum += step;
      ++steps;
    }
    if (!shortest || step.norm() < shortest->norm()) {
      shortest = step;
    }
    stands_out = stands_out && end.range < neighbor->range;
  }
  if (steps > 0) {
    return Point2(sum / steps);
  }
  return stands_out ? std::nullopt : shortest;
}

std::vector<End> endsOf(const Scan& scan) {
  std::vector<End> ends;
  ends.reserve(scan.rays.size());
  for (const Ray& ray : scan.rays) {
    if (ray.hit) {
      ends.push_back({ray.end, ray.range, stepAcross(ray, scan.field.beam_spacing)});
    }
  }
  return ends;
}

}  // namespace

std::vector<EndPoint> endPoints(const Scan& scan, double max_step) {
  const std::vector<End> ends = endsOf(scan);
  std::vector<EndPoint> points;
  points.reserve(ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const End* previous = i > 0 ? &ends[i - 1] : nullptr;
    const End* next = i + 1 < ends.size() ? &ends[i + 1] : nullptr;
    const Point2 interval =
        stepAlongSurface(previous, ends[i], next, max_step).value_or(ends[i].across);
    points.push_back({ends[i].position, kUniformVariance * interval * interval.transpose()});
  }
  return points;
}

}  // namespace datmo
