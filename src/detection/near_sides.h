// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "datmo_fusion/common/cross.h"
#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Cost of a point far from all sides, as at this many squared standard deviations.
inline constexpr double kMaxCost = 4.0;

/// Points closer to a line than this, in standard deviations, may lie on it.
inline constexpr double kOnLine = 3.0;

/// Position of a side that does not exist.
inline constexpr double kNone = std::numeric_limits<double>::infinity();

/// Points relative to the scanner.
using Points = std::vector<Point2>;

/// The axes of a heading.
struct Axes {
  explicit Axes(double heading) : along(std::cos(heading), std::sin(heading)) {}
  Point2 operator()(const Point2& point) const {
    return {along.x() * point.x() + along.y() * point.y(), cross(along, point)};
  }
  Point2 along;
};

/// Lines at constant first and second coordinate that face the scanner, which is at the origin;
/// kNone: it does not see the side across this axis.
struct NearSides {
  Point2 position;
  std::array<bool, 2> ahead{};  ///< the side is at the positive end of the object

  /// Returns the distance to the nearer one, m.
  double distance(const Point2& local) const { return (local - position).cwiseAbs().minCoeff(); }

  /// Returns the axis that the nearer one is across.
  int nearest(const Point2& local) const {
    return std::abs(local.x() - position.x()) <= std::abs(local.y() - position.y()) ? 0 : 1;
  }
};

struct Extent {
  Point2 min = Point2::Constant(kNone);
  Point2 max = Point2::Constant(-kNone);

  /// Returns the near sides if no point is in front of them.
  NearSides nearSides() const {
    const auto position = [&](int axis) {
      return min[axis] > 0.0 ? min[axis] : (max[axis] < 0.0 ? max[axis] : kNone);
    };
    NearSides sides{{position(0), position(1)}, {max.x() < 0.0, max.y() < 0.0}};
    if (sides.position.x() == kNone && sides.position.y() == kNone) {
      sides.position = min;  // the scanner is inside: no side is nearer than another
    }
    return sides;
  }
};

inline Extent extentOf(const Points& points, const Axes& axes) {
  Extent extent;
  for (const Point2& point : points) {
    const Point2 local = axes(point);
    extent.min = extent.min.cwiseMin(local);
    extent.max = extent.max.cwiseMax(local);
  }
  return extent;
}

}  // namespace datmo
