// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/path.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "datmo_fusion/common/twist2.h"

namespace datmo::simulator {

namespace {

/// A corner sharper than this (rad) has no useful arc, because its legs nearly coincide.
constexpr double kSharpest = degrees(175.0);

double headingOf(const Point2& leg) { return std::atan2(leg.y(), leg.x()); }

/// Length along each leg that the arc at the corner between them takes, m.
double tangentLength(const Point2& before, const Point2& after, double corner_radius) {
  const double turn = std::abs(angleBetween(headingOf(before), headingOf(after)));
  const double max = 0.5 * std::min(before.norm(), after.norm());
  return std::min(corner_radius * std::tan(0.5 * turn), max);
}

void check(const Polyline& points, double corner_radius) {
  if (points.size() < 2) {
    throw std::invalid_argument("a path of " + std::to_string(points.size()) +
                                " points: expected at least 2");
  }
  if (!(corner_radius >= 0.0)) {
    throw std::invalid_argument("a corner radius of " + std::to_string(corner_radius) +
                                " m: expected at least 0");
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point2 leg = points[i + 1] - points[i];
    if (!(leg.norm() > 0.0)) {
      throw std::invalid_argument("points " + std::to_string(i) + " and " + std::to_string(i + 1) +
                                  " of the path are the same: expected different ones");
    }
    if (i > 0 &&
        std::abs(angleBetween(headingOf(points[i] - points[i - 1]), headingOf(leg))) > kSharpest) {
      throw std::invalid_argument("the path turns back at point " + std::to_string(i) +
                                  ": expected a turn of at most 175 degrees");
    }
  }
}

}  // namespace

Path::Path(const Polyline& points, double corner_radius) {
  check(points, corner_radius);
  double taken = 0.0;  // of the leg, by the arc at its start
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point2 leg = points[i + 1] - points[i];
    const double heading = headingOf(leg);
    const bool last = i + 2 == points.size();
    const Point2 next_leg = last ? leg : Point2(points[i + 2] - points[i + 1]);
    const double arc_tangent = last ? 0.0 : tangentLength(leg, next_leg, corner_radius);
    append(Pose2(points[i] + leg.normalized() * taken, heading), 0.0,
           leg.norm() - taken - arc_tangent);
    if (arc_tangent > 0.0) {
      const double turn = angleBetween(heading, headingOf(next_leg));
      const double curvature = std::tan(0.5 * turn) / arc_tangent;
      append(Pose2(points[i + 1] - leg.normalized() * arc_tangent, heading), curvature,
             turn / curvature);
    }
    taken = arc_tangent;
  }
}

void Path::append(const Pose2& start, double curvature, double length) {
  if (length > 0.0) {
    pieces_.push_back({start, curvature, length, length_});
    length_ += length;
  }
}

PathPoint Path::at(double arc_length) const {
  if (arc_length > length_) {
    const PathPoint end = at(length_);
    return {end.pose * Pose2(arc_length - length_, 0.0, 0.0), 0.0};
  }
  if (arc_length < 0.0) {
    return {pieces_.front().start * Pose2(arc_length, 0.0, 0.0), 0.0};
  }
  const auto next =
      std::upper_bound(pieces_.begin(), pieces_.end(), arc_length,
                       [](double w, const Piece& piece) { return w < piece.arc_length; });
  const Piece& piece = *std::prev(next);
  const double along = arc_length - piece.arc_length;
  return {piece.start * arc({1.0, piece.curvature}, along), piece.curvature};
}

Polyline Path::points(double arc_step) const {
  Polyline line;
  for (const Piece& piece : pieces_) {
    const int steps = piece.curvature == 0.0
                          ? 1
                          : std::max(1, static_cast<int>(std::ceil(piece.length / arc_step)));
    for (int i = 0; i < steps; ++i) {
      line.push_back(at(piece.arc_length + piece.length * i / steps).pose.position());
    }
  }
  line.push_back(at(length_).pose.position());
  return line;
}

}  // namespace datmo::simulator
