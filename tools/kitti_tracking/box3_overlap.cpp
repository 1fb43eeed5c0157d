// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/box3_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "datmo_fusion/common/cross.h"

namespace datmo::kitti {

namespace {

/// Corners of the remaining polygon while a rectangle is clipped by the sides of another. A cut of
/// a convex polygon adds one corner; if rounding moves corners on the line to the other side, at
/// most half as many as there are: 4, 6, 9, 13, 19.
struct Polygon {
  std::array<Eigen::Vector2d, 19> corners;
  std::size_t size = 0;

  void add(const Eigen::Vector2d& corner) { corners[size++] = corner; }
};

Eigen::Vector2d groundCenter(const Box3& box) { return {box.x, box.z}; }

/// Corners on the ground in x and z from `origin`, in the rotation from x to z.
Polygon footprint(const Box3& box, const Eigen::Vector2d& origin) {
  const Eigen::Vector2d ahead(std::cos(box.rotation_y), -std::sin(box.rotation_y));
  const Eigen::Vector2d half_length = 0.5 * box.length * ahead;
  const Eigen::Vector2d half_width = 0.5 * box.width * Eigen::Vector2d(-ahead.y(), ahead.x());
  const Eigen::Vector2d center = groundCenter(box) - origin;
  Polygon polygon;
  polygon.add(center + half_length - half_width);
  polygon.add(center + half_length + half_width);
  polygon.add(center - half_length + half_width);
  polygon.add(center - half_length - half_width);
  return polygon;
}

/// The part of the polygon on the inner side of the line from `from` to `to`; the line counts as
/// inside (Sutherland and Hodgman, Reentrant polygon clipping, 1974).
Polygon cut(const Polygon& polygon, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  Polygon rest;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Eigen::Vector2d& here = polygon.corners[i];
    const Eigen::Vector2d& next = polygon.corners[(i + 1) % polygon.size];
    const double here_inside = cross(to - from, here - from);
    const double next_inside = cross(to - from, next - from);
    if (here_inside >= 0.0) {
      rest.add(here);
    }
    if ((here_inside > 0.0 && next_inside < 0.0) || (here_inside < 0.0 && next_inside > 0.0)) {
      rest.add(here + (next - here) * (here_inside / (here_inside - next_inside)));
    }
  }
  return rest;
}

double area(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    twice += cross(polygon.corners[i], polygon.corners[(i + 1) % polygon.size]);
  }
  return std::max(0.0, 0.5 * twice);
}

/// Whether circles around the footprints touch.
bool mayMeet(const Box3& a, const Box3& b) {
  const double reach = 0.5 * (std::hypot(a.length, a.width) + std::hypot(b.length, b.width));
  return (groundCenter(a) - groundCenter(b)).squaredNorm() <= reach * reach;
}

double volume(const Box3& box) { return box.length * box.width * box.height; }

}  // namespace

double groundIntersection(const Box3& a, const Box3& b) {
  if (!mayMeet(a, b)) {
    return 0.0;
  }
  const Eigen::Vector2d origin = groundCenter(a);
  const Polygon knife = footprint(b, origin);
  Polygon rest = footprint(a, origin);
  for (std::size_t i = 0; i < knife.size && rest.size > 0; ++i) {
    rest = cut(rest, knife.corners[i], knife.corners[(i + 1) % knife.size]);
  }
  return area(rest);
}

double overlap3d(const Box3& a, const Box3& b) {
  const double top = std::max(a.y - a.height, b.y - b.height);
  const double bottom = std::min(a.y, b.y);
  const double common = groundIntersection(a, b) * std::max(0.0, bottom - top);
  const double all = volume(a) + volume(b) - common;
  return all > 0.0 ? common / all : 0.0;
}

}  // namespace datmo::kitti
