#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Cost of a point that lies nowhere near a side, as of one at so many standard deviations squared.
inline constexpr double kMostCost = 4.0;

/// Points nearer to a line than this, in standard deviations, may lie on it.
inline constexpr double kOnLine = 3.0;

/// Where a side is that there is none of.
inline constexpr double kNone = std::numeric_limits<double>::infinity();

/// Points about the scanner.
using Points = std::vector<Point2>;

/// The axes of a heading.
struct Axes {
  explicit Axes(double heading) : along(std::cos(heading), std::sin(heading)) {}
  Point2 operator()(const Point2& point) const {
    return {along.x() * point.x() + along.y() * point.y(),
            along.x() * point.y() - along.y() * point.x()};
  }
  Point2 along;
};

/// Lines at constant first and second coordinate that face the scanner, which is at the origin;
/// kNone: it does not see the side across this axis.
struct NearSides {
  Point2 place;
  std::array<bool, 2> ahead{};  ///< the side is at the positive end of the object

  /// Distance to the nearer one, m.
  double distance(const Point2& local) const { return (local - place).cwiseAbs().minCoeff(); }

  /// The axis that the nearer one is across.
  int nearest(const Point2& local) const {
    return std::abs(local.x() - place.x()) <= std::abs(local.y() - place.y()) ? 0 : 1;
  }
};

struct Extent {
  Point2 least = Point2::Constant(kNone);
  Point2 most = Point2::Constant(-kNone);

  /// Where the near sides are if no point is in front of them.
  NearSides nearSides() const {
    const auto place = [&](int axis) {
      return least[axis] > 0.0 ? least[axis] : (most[axis] < 0.0 ? most[axis] : kNone);
    };
    NearSides sides{{place(0), place(1)}, {most.x() < 0.0, most.y() < 0.0}};
    if (sides.place.x() == kNone && sides.place.y() == kNone) {
      sides.place = least;  // the scanner is inside: no side is nearer than another
    }
    return sides;
  }
};

inline Extent extentOf(const Points& points, const Axes& axes) {
  Extent extent;
  for (const Point2& point : points) {
    const Point2 local = axes(point);
    extent.least = extent.least.cwiseMin(local);
    extent.most = extent.most.cwiseMax(local);
  }
  return extent;
}

}  // namespace datmo
