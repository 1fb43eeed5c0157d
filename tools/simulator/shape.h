// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "datmo_fusion/common/box2.h"

namespace datmo::simulator {

struct Circle {
  Point2 center = Point2::Zero();
  double radius = 0.0;  ///< m
};

struct Segment {
  Point2 start = Point2::Zero();
  Point2 end = Point2::Zero();
};

/// Outline of an object on the ground, m, world frame.
using Shape = std::variant<Box2, Circle, Segment>;

/// A half line; `direction` has length 1.
struct HalfLine {
  Point2 origin = Point2::Zero();
  Point2 direction = Point2::UnitX();
};

/// The half line from a point at a heading (rad).
HalfLine halfLine(const Point2& origin, double heading);

/// The part of a half line that is inside an outline, m from its origin; negative: behind it.
struct RaySpan {
  double enter = 0.0;
  double leave = 0.0;  ///< not less than `enter`; the same on a segment
};

/// The smallest circle about the shape's center that contains it.
Circle boundingCircle(const Shape& shape);

/// The interval in which the half line's full line is inside the outline; none if it misses.
std::optional<RaySpan> spanAlong(const Shape& shape, const HalfLine& ray);

/// Range (m) at which the half line first hits the outline; from inside, where it leaves.
std::optional<double> rangeTo(const Shape& shape, const HalfLine& ray);

/// From the point to the nearest point of the shape, m; 0 inside.
double distanceTo(const Shape& shape, const Point2& point);

/// Whether two shapes have points in common; touching counts.
bool overlap(const Shape& a, const Shape& b);

}  // namespace datmo::simulator
