// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/random.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

/// Returns the distance (m) at which a beam from `from` along `direction`, in a box's frame, enters
/// the box; nothing if it misses it.
inline std::optional<double> distanceInto(const Box2& box, const Point2& from,
                                          const Point2& direction) {
  const Pose2 to_box = box.center.inverse();
  const Point2 start = to_box * from;
  const Point2 along = to_box.rotate(direction);
  const Point2 half(0.5 * box.length, 0.5 * box.width);
  double in = 0.0;
  double out = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    double one = (-half[axis] - start[axis]) / along[axis];
    double other = (half[axis] - start[axis]) / along[axis];
    if (one > other) {
      std::swap(one, other);
    }
    in = std::fmax(in, one);
    out = std::fmin(out, other);
  }
  return in < out ? std::optional<double>(in) : std::nullopt;
}

/// A scanner at the origin that faces along x, with a field of view symmetric about it.
struct RayCaster {
  ScanField field;
  double range_sigma = 0.0;  ///< m

  /// A field of view of this angle (rad), with a beam every `spacing` (rad).
  RayCaster(double angle, double spacing, double sigma) : range_sigma(sigma) {
    field.first_bearing = -0.5 * angle;
    field.beam_spacing = spacing;
    field.beams = static_cast<std::uint32_t>(std::lround(angle / spacing)) + 1;
    field.free_range = 100.0;
    field.range = 100.0;
  }

  /// Returns its scan of boxes whose points are all moving, with noise on the ranges.
  LabeledScan scan(const std::vector<Box2>& boxes, Random& random) const {
    LabeledScan scan;
    scan.field = field;
    for (std::uint32_t beam = 0; beam < field.beams; ++beam) {
      const double bearing = field.first_bearing + field.beam_spacing * beam;
      const Point2 direction(std::cos(bearing), std::sin(bearing));
      double range = field.range;
      for (const Box2& box : boxes) {
        range =
            std::fmin(range, distanceInto(box, Point2::Zero(), direction).value_or(field.range));
      }
      if (range < field.range) {
        range += random.normal(range_sigma);
        scan.points.push_back({range * direction, range, bearing, beam, PointState::kMoving});
      }
    }
    return scan;
  }
};

}  // namespace datmo
