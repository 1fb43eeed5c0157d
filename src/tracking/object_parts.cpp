// SPDX-License-Identifier: BSD-3-Clause
#include "object_parts.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace datmo {

namespace {

/// Outward normals of the sides of a box, in the order of BoxSide.
std::array<Point2, kBoxSides> normalsOf(const Box2& box) {
  const Point2 ahead = box.center.rotate(Point2::UnitX());
  const Point2 left = box.center.rotate(Point2::UnitY());
  return {ahead, -ahead, left, -left};
}

/// How far the box extends in a direction from the origin, m.
double reachAlong(const Box2& box, const Point2& direction) {
  double reach = -std::numeric_limits<double>::infinity();
  for (const Point2& corner : box.corners()) {
    reach = std::max(reach, corner.dot(direction));
  }
  return reach;
}

/// Variance of the side that faces this direction most.
double sideVariance(const Object& object, const Point2& direction) {
  const std::array<Point2, kBoxSides> normals = normalsOf(object.box);
  std::size_t best = 0;
  for (std::size_t side = 1; side < kBoxSides; ++side) {
    if (normals[side].dot(direction) > normals[best].dot(direction)) {
      best = side;
    }
  }
  return object.side_variance[best];
}

/// The smallest box of this heading that contains all points; at least one.
Box2 boxHolding(const std::vector<Point2>& points, double heading) {
  const Pose2 axes(Point2::Zero(), heading);
  const Pose2 back = axes.inverse();
  Point2 min = back * points.front();
  Point2 max = min;
  for (const Point2& point : points) {
    const Point2 local = back * point;
    min = min.cwiseMin(local);
    max = max.cwiseMax(local);
  }
  const Point2 size = max - min;
  return {Pose2(axes * Point2(0.5 * (min + max)), heading), size.x(), size.y()};
}

/// The class of an object tells little about the whole that it is a part of, or about its own
/// parts; and along the axes of a target it carries no information on the target's heading.
void forgetKind(Object& object) {
  object.class_probabilities = {};
  object.heading_variance = kUnknownHeadingVariance;
}

}  // namespace

Object unionOf(const std::vector<const Object*>& parts, double heading) {
  Object whole = *parts.front();
  forgetKind(whole);
  std::vector<Point2> corners;
  whole.points.clear();
  for (const Object* part : parts) {
    const auto box = part->box.corners();
    corners.insert(corners.end(), box.begin(), box.end());
    whole.points.insert(whole.points.end(), part->points.begin(), part->points.end());
    if (part->position_covariance.trace() > whole.position_covariance.trace()) {
      whole.position_covariance = part->position_covariance;
    }
    if (!whole.velocity || (part->velocity && part->velocity->covariance.trace() <
                                                  whole.velocity->covariance.trace())) {
      whole.velocity = part->velocity;
    }
    whole.dynamic_state = std::max(whole.dynamic_state, part->dynamic_state);
    whole.height = std::max(whole.height, part->height);
    whole.log_odds = std::max(whole.log_odds, part->log_odds);
    whole.motion_log_odds = std::max(whole.motion_log_odds, part->motion_log_odds);
  }
  whole.box = boxHolding(corners, heading);
  const std::array<Point2, kBoxSides> normals = normalsOf(whole.box);
  for (std::size_t side = 0; side < kBoxSides; ++side) {
    const Object* outermost =
        *std::max_element(parts.begin(), parts.end(), [&](const Object* a, const Object* b) {
          return reachAlong(a->box, normals[side]) < reachAlong(b->box, normals[side]);
        });
    whole.side_variance[side] = sideVariance(*outermost, normals[side]);
  }
  return whole;
}

Object partOf(const Object& whole, std::vector<Point2> points, double heading,
              const Point2& other) {
  Object part = whole;
  forgetKind(part);
  part.box = boxHolding(points, heading);
  part.points = std::move(points);
  const std::array<Point2, kBoxSides> normals = normalsOf(part.box);
  std::size_t inner = 0;
  for (std::size_t side = 0; side < kBoxSides; ++side) {
    part.side_variance[side] = sideVariance(whole, normals[side]);
    inner = normals[side].dot(other) > normals[inner].dot(other) ? side : inner;
  }
  part.side_variance[inner] = kHiddenSide;
  return part;
}

}  // namespace datmo
