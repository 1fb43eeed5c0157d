// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// A rectangle on the ground: center and heading, length along the heading, and width.
struct Box2 {
  Pose2 center;
  double length = 0.0;  ///< m, at least 0
  double width = 0.0;   ///< m, at least 0

  /// Returns the corners: front left, rear left, rear right, front right.
  std::array<Point2, 4> corners() const;

  /// Returns the distance from the center to the corners, m.
  double halfDiagonal() const;

  /// Returns whether the point is inside; points on the border are.
  bool contains(const Point2& point) const;

  /// Returns the distance from the point to the nearest point of the rectangle, m; 0 inside.
  double distanceTo(const Point2& point) const;

 private:
  /// How far the point lies beyond the sides, along both axes of the box, m; 0 within them.
  Point2 beyond(const Point2& point) const;
};

}  // namespace datmo
