// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/box2.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

/// m, bound on the rounding error of distances.
constexpr double kRounding = 1e-6;

}  // namespace

std::array<Point2, 4> Box2::corners() const {
  const double x = 0.5 * length;
  const double y = 0.5 * width;
  return {center * Point2(x, y), center * Point2(-x, y), center * Point2(-x, -y),
          center * Point2(x, -y)};
}

Point2 Box2::beyond(const Point2& point) const {
  const Point2 local = Pose2(Point2::Zero(), -center.heading()).rotate(point - center.position());
  return {std::max(0.0, std::abs(local.x()) - 0.5 * length),
          std::max(0.0, std::abs(local.y()) - 0.5 * width)};
}

double Box2::halfDiagonal() const { return 0.5 * std::sqrt(length * length + width * width); }

bool Box2::contains(const Point2& point) const {
  // Quick test for most points: the corners are half the diagonal away, and the nearest side half
  // the shorter side.
  const double distance2 = (point - center.position()).squaredNorm();
  const double reach = halfDiagonal() + kRounding;
  const double inside = 0.5 * std::min(length, width) - kRounding;
  if (distance2 > reach * reach) {
    return false;
  }
  return (inside > 0.0 && distance2 < inside * inside) || beyond(point).isZero(0.0);
}

double Box2::distanceTo(const Point2& point) const {
  const Point2 farther = beyond(point);
  return std::hypot(farther.x(), farther.y());
}

}  // namespace datmo
