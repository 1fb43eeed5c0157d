// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "datmo_fusion/common/cross.h"

namespace datmo::simulator {

namespace {

/// Interval of the half line inside the slab |coordinate| <= half, intersected with `[enter,
/// leave]`.
void cutWithSlab(double origin, double direction, double half, double& enter, double& leave) {
  if (direction == 0.0) {
    if (std::abs(origin) > half) {
      leave = -std::numeric_limits<double>::infinity();
    }
    return;
  }
  const double first = (-half - origin) / direction;
  const double second = (half - origin) / direction;
  enter = std::max(enter, std::min(first, second));
  leave = std::min(leave, std::max(first, second));
}

std::optional<RaySpan> spanInBox(const Box2& box, const HalfLine& ray) {
  const Pose2 world_in_box = box.center.inverse();
  const Point2 origin = world_in_box * ray.origin;
  const Point2 direction = world_in_box.rotate(ray.direction);
  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  cutWithSlab(origin.x(), direction.x(), 0.5 * box.length, enter, leave);
  cutWithSlab(origin.y(), direction.y(), 0.5 * box.width, enter, leave);
  if (enter > leave) {
    return std::nullopt;
  }
  return RaySpan{enter, leave};
}

std::optional<RaySpan> spanInCircle(const Circle& circle, const HalfLine& ray) {
  const Point2 to_center = circle.center - ray.origin;
  const double along = to_center.dot(ray.direction);
  const double across = cross(ray.direction, to_center);
  const double half_chord_squared = circle.radius * circle.radius - across * across;
  if (half_chord_squared < 0.0) {
    return std::nullopt;
  }
  const double half_chord = std::sqrt(half_chord_squared);
  return RaySpan{along - half_chord, along + half_chord};
}

std::optional<RaySpan> spanOnSegment(const Segment& segment, const HalfLine& ray) {
  const Point2 edge = segment.end - segment.start;
  const Point2 to_start = segment.start - ray.origin;
  const double denominator = cross(ray.direction, edge);
  if (denominator == 0.0) {
    return std::nullopt;
  }
  const double range = cross(to_start, edge) / denominator;
  const double share = cross(to_start, ray.direction) / denominator;
  if (share < 0.0 || share > 1.0) {
    return std::nullopt;
  }
  return RaySpan{range, range};
}

double distanceToSegment(const Segment& segment, const Point2& point) {
  const Point2 edge = segment.end - segment.start;
  const double length_squared = edge.squaredNorm();
  const double share =
      length_squared > 0.0
          ? std::clamp((point - segment.start).dot(edge) / length_squared, 0.0, 1.0)
          : 0.0;
  return (point - segment.start - share * edge).norm();
}

/// The corners of a box or a segment, in order.
std::vector<Point2> corners(const Shape& shape) {
  if (const auto* box = std::get_if<Box2>(&shape)) {
    const std::array<Point2, 4> points = box->corners();
    return {points.begin(), points.end()};
  }
  const auto& segment = std::get<Segment>(shape);
  return {segment.start, segment.end};
}

struct Interval {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
};

Interval project(const std::vector<Point2>& points, const Point2& axis) {
  Interval interval;
  for (const Point2& point : points) {
    interval.min = std::min(interval.min, point.dot(axis));
    interval.max = std::max(interval.max, point.dot(axis));
  }
  return interval;
}

/// Whether an edge of `a`, or the normal of one, is a separating direction of the two.
bool separatedByEdgesOf(const std::vector<Point2>& a, const std::vector<Point2>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Point2 edge = a[(i + 1) % a.size()] - a[i];
    for (const Point2& axis : {edge, Point2(-edge.y(), edge.x())}) {
      const Interval of_a = project(a, axis);
      const Interval of_b = project(b, axis);
      if (of_a.max < of_b.min || of_b.max < of_a.min) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

HalfLine halfLine(const Point2& origin, double heading) {
  return {origin, Point2(std::cos(heading), std::sin(heading))};
}

Circle boundingCircle(const Shape& shape) {
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    return *circle;
  }
  if (const auto* box = std::get_if<Box2>(&shape)) {
    return {box->center.position(), 0.5 * Point2(box->length, box->width).norm()};
  }
  const auto& segment = std::get<Segment>(shape);
  return {0.5 * (segment.start + segment.end), 0.5 * (segment.end - segment.start).norm()};
}

std::optional<RaySpan> spanAlong(const Shape& shape, const HalfLine& ray) {
  if (const auto* box = std::get_if<Box2>(&shape)) {
    return spanInBox(*box, ray);
  }
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    return spanInCircle(*circle, ray);
  }
  return spanOnSegment(std::get<Segment>(shape), ray);
}

std::optional<double> rangeTo(const Shape& shape, const HalfLine& ray) {
  const std::optional<RaySpan> span = spanAlong(shape, ray);
  if (!span || span->leave < 0.0) {
    return std::nullopt;
  }
  return span->enter >= 0.0 ? span->enter : span->leave;
}

double distanceTo(const Shape& shape, const Point2& point) {
  if (const auto* box = std::get_if<Box2>(&shape)) {
    return box->distanceTo(point);
  }
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    return std::max(0.0, (point - circle->center).norm() - circle->radius);
  }
  return distanceToSegment(std::get<Segment>(shape), point);
}

bool overlap(const Shape& a, const Shape& b) {
  if (const auto* circle = std::get_if<Circle>(&a)) {
    return distanceTo(b, circle->center) <= circle->radius;
  }
  if (const auto* circle = std::get_if<Circle>(&b)) {
    return distanceTo(a, circle->center) <= circle->radius;
  }
  const std::vector<Point2> corners_a = corners(a);
  const std::vector<Point2> corners_b = corners(b);
  return !separatedByEdgesOf(corners_a, corners_b) && !separatedByEdgesOf(corners_b, corners_a);
}

}  // namespace datmo::simulator
