// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// A rectangle on the ground: its center and heading, its length along the heading and its width.
struct Box2 {
  Pose2 center;
  double length = 0.0;  ///< m, at least 0
  double width = 0.0;   ///< m, at least 0

  /// Front left, rear left, rear right, front right.
  std::array<Point2, 4> corners() const;

  /// Border points count as inside.
  bool contains(const Point2& point) const;

  /// From the point to the nearest point of the rectangle, m; 0 inside.
  double distanceTo(const Point2& point) const;

 private:
  /// How far the point lies beyond the sides, along both axes of the box, m; 0 between them.
  Point2 beyond(const Point2& point) const;
};

}  // namespace datmo
