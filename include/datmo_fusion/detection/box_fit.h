// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/object.h"

namespace datmo {

/// A rectangle fitted to points on its near sides, and its uncertainty.
struct BoxFit {
  /// Its near sides are at the mean position of the points, its ends at the outermost points. For a
  /// single side: as deep as the points reach behind it beyond noise, mostly 0.
  Box2 box;
  double heading_variance = kUnknownHeadingVariance;  ///< rad^2, modulo a quarter turn
  double noise = 0.0;  ///< m, standard deviation of a point about its side
  /// By BoxSide: number of points on it. 0: not seen, or only its ends.
  std::array<std::size_t, kBoxSides> points_on_side{};
};

/// Noise of points about the side that they lie on.
struct PointNoise {
  double sigma;  ///< m, more than 0: expected standard deviation
  double correlated_points =
      1.0;  ///< 1 or more: number of points that share their noise and count as one
};

/// Fits a rectangle to the visible part of an object: one side (I), two sides (L), or a point.
///
/// Of all headings in steps of 6 degrees, the one is taken at which the points lie nearest to the
/// sides that face the scanner (after Zhang, Xu, Dong, Dolan, Efficient L-shape fitting for vehicle
/// detection using laser scanners, 2017, with a bounded distance cost); then heading and sides are
/// refined together by robust total least squares. The heading's variance is that of the least
/// squares, multiplied by the number of points that share their noise, plus the spread of the other
/// headings that explain the points as well: a few points may lie on one side or on two.
///
/// @param points m; std::invalid_argument if empty. One: a box without width across the line of
/// sight
/// @param scanner m, position from which the points were seen, same frame
BoxFit fitBox(const std::vector<Point2>& points, const Point2& scanner, const PointNoise& expected);

/// Returns the rectangle across the line of sight, for points that do not determine a heading: one
/// side at their mean distance, its ends at the outermost of them, with unknown heading.
///
/// @param points m; std::invalid_argument if empty
/// @param noise m, of one point about the side
BoxFit boxAcross(const std::vector<Point2>& points, const Point2& scanner, double noise);

}  // namespace datmo
