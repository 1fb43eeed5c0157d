// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/object.h"

namespace datmo {

/// The rectangle whose near sides points lie on, and how well it is known.
struct BoxFit {
  /// Its near sides where the points are on average, its ends at the outermost points. Of a single
  /// side: as deep as the points reach behind it beyond noise, mostly 0.
  Box2 box;
  double heading_variance = kUnknownHeadingVariance;  ///< rad^2, modulo a quarter turn
  double noise = 0.0;  ///< m, standard deviation of a point about its side
  /// By BoxSide: how many points lie on it. 0: not seen, or only its ends.
  std::array<std::size_t, kBoxSides> points_on_side{};
};

/// Of points about the side that they lie on.
struct PointNoise {
  double sigma;                    ///< m, more than 0: expected standard deviation
  double correlated_points = 1.0;  ///< 1 or more: so many share their noise, and count as one
};

/// Fits a rectangle to what a scanner saw of an object: one side (I), two sides (L), or a point.
///
/// Of all headings in steps of 6 degrees, the one is taken at which the points lie nearest to the
/// sides that face the scanner (after Zhang, Xu, Dong, Dolan, Efficient L-shape fitting for vehicle
/// detection using laser scanners, 2017, with a bounded cost of the distance); then heading and
/// sides are fitted together by robust total least squares. The heading's variance is that of the
/// least squares, as many times as points share their noise, and the spread of the other headings
/// that explain the points as well: few points may lie on one side or on two.
///
/// @param points m; none: std::invalid_argument. One: a box without size across the line of sight.
/// @param scanner m, from where the points were seen, same frame
BoxFit fitBox(const std::vector<Point2>& points, const Point2& scanner, const PointNoise& expected);

/// The rectangle across the line of sight, where points do not tell a heading: one side at their
/// mean distance, its ends at the outermost of them; nothing is known of its heading.
///
/// @param points m; none: std::invalid_argument
/// @param noise m, of one point about the side
BoxFit boxAcross(const std::vector<Point2>& points, const Point2& scanner, double noise);

}  // namespace datmo
