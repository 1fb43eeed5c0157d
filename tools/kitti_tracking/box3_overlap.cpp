// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/box3_overlap.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
// Without it, Boost 1.74 rounds coordinates to a grid, and areas by 1e-7 of themselves.
#define BOOST_GEOMETRY_NO_ROBUSTNESS
#include <boost/geometry/algorithms/append.hpp>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/intersection.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/strategies/strategies.hpp>

namespace datmo::kitti {

namespace {

namespace geometry = boost::geometry;
using GroundPoint = geometry::model::d2::point_xy<double>;  // x, z
using Polygon = geometry::model::polygon<GroundPoint>;

Eigen::Vector2d groundCenter(const Box3& box) { return {box.x, box.z}; }

/// Relative to `origin`: rounding is that of the boxes' sizes, wherever they are.
Polygon footprint(const Box3& box, const Eigen::Vector2d& origin) {
  const Eigen::Vector2d ahead(std::cos(box.rotation_y), -std::sin(box.rotation_y));
  const Eigen::Vector2d half_length = 0.5 * box.length * ahead;
  const Eigen::Vector2d half_width = 0.5 * box.width * Eigen::Vector2d(-ahead.y(), ahead.x());
  const Eigen::Vector2d center = groundCenter(box) - origin;
  Polygon polygon;
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(center + half_length - half_width),
                                        Eigen::Vector2d(center + half_length + half_width),
                                        Eigen::Vector2d(center - half_length + half_width),
                                        Eigen::Vector2d(center - half_length - half_width)}) {
    geometry::append(polygon, GroundPoint(corner.x(), corner.y()));
  }
  geometry::correct(polygon);
  return polygon;
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
  geometry::model::multi_polygon<Polygon> common;
  geometry::intersection(footprint(a, origin), footprint(b, origin), common);
  return geometry::area(common);
}

double overlap3d(const Box3& a, const Box3& b) {
  const double top = std::max(a.y - a.height, b.y - b.height);
  const double bottom = std::min(a.y, b.y);
  const double common = groundIntersection(a, b) * std::max(0.0, bottom - top);
  const double all = volume(a) + volume(b) - common;
  return all > 0.0 ? common / all : 0.0;
}

}  // namespace datmo::kitti
