#include "datmo_fusion/tracking/box_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace datmo_fusion {

namespace {

/// The widest strip outside of `box`, parallel to its sides, without a corner of `other`.
double gapOutside(const Box2& box, const Box2& other) {
  const double inf = std::numeric_limits<double>::infinity();
  Point2 least(inf, inf);
  Point2 most(-inf, -inf);
  for (const Point2& corner : other.corners()) {
    const Point2 local = box.centre.inverse() * corner;
    least = least.cwiseMin(local);
    most = most.cwiseMax(local);
  }
  const Point2 half(0.5 * box.length, 0.5 * box.width);
  return std::max((least - half).maxCoeff(), (-half - most).maxCoeff());
}

}  // namespace

double gapBetween(const Box2& a, const Box2& b) {
  return std::max({0.0, gapOutside(a, b), gapOutside(b, a)});
}

}  // namespace datmo_fusion
