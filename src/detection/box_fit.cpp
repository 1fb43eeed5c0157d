#include "datmo_fusion/detection/box_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace datmo {

namespace {

constexpr int kHeadings = 45;  ///< over a quarter turn: steps of 2 degrees

/// Points nearer to an edge than this (m) are all as good: the scanner's noise.
constexpr double kNearEdge = 0.05;

/// Extent of the points along the axes of a heading.
struct Extent {
  Point2 least = Point2::Constant(std::numeric_limits<double>::infinity());
  Point2 most = Point2::Constant(-std::numeric_limits<double>::infinity());
};

std::vector<Point2> turned(const std::vector<Point2>& points, double heading) {
  const Pose2 frame(Point2::Zero(), -heading);
  std::vector<Point2> result;
  result.reserve(points.size());
  for (const Point2& point : points) {
    result.push_back(frame.rotate(point));
  }
  return result;
}

Extent extentOf(const std::vector<Point2>& points) {
  Extent extent;
  for (const Point2& point : points) {
    extent.least = extent.least.cwiseMin(point);
    extent.most = extent.most.cwiseMax(point);
  }
  return extent;
}

/// High where the points lie close to the edges of their extent.
double closeness(const std::vector<Point2>& points, const Extent& extent) {
  double sum = 0.0;
  for (const Point2& point : points) {
    const Point2 to_edge = (point - extent.least).cwiseMin(extent.most - point);
    sum += 1.0 / std::max(to_edge.minCoeff(), kNearEdge);
  }
  return sum;
}

Box2 boxOf(const Extent& extent, double heading) {
  const Point2 size = extent.most - extent.least;
  const Point2 centre = Pose2(Point2::Zero(), heading).rotate(0.5 * (extent.least + extent.most));
  const bool along = size.x() >= size.y();
  double direction = along ? heading : heading + 0.5 * kPi;
  if (direction > 0.5 * kPi) {
    direction -= kPi;
  } else if (direction <= -0.5 * kPi) {
    direction += kPi;
  }
  return {{centre, direction}, std::max(size.x(), size.y()), std::min(size.x(), size.y())};
}

}  // namespace

Box2 fitBox(const std::vector<Point2>& points) {
  if (points.empty()) {
    throw std::invalid_argument("fitBox: 0 points, expected 1 or more");
  }
  if (points.size() == 2) {
    const Point2 side = points[1] - points[0];
    const double heading = std::atan2(side.y(), side.x());
    return boxOf(extentOf(turned(points, heading)), heading);
  }
  double best_heading = 0.0;
  double best = -1.0;
  for (int i = 0; i < kHeadings; ++i) {
    const double heading = 0.5 * kPi * i / kHeadings;
    const std::vector<Point2> local = turned(points, heading);
    const double value = closeness(local, extentOf(local));
    if (value > best) {
      best = value;
      best_heading = heading;
    }
  }
  return boxOf(extentOf(turned(points, best_heading)), best_heading);
}

}  // namespace datmo
