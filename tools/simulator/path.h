// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/pose2.h"

namespace datmo::simulator {

using Polyline = std::vector<Point2>;

/// Point of a path at an arc length.
struct PathPoint {
  Pose2 pose;              ///< on the path, heading along it
  double curvature = 0.0;  ///< 1/m, positive to the left
};

/// A polyline whose corners are rounded by circular arcs, parameterized by arc length.
class Path {
 public:
  /// `points`: at least two, m, no two neighbors equal and no reversal of direction.
  /// `corner_radius`: m, at least 0; if a leg is too short for it, the arc is made smaller. Throws
  /// std::invalid_argument on other input.
  Path(const Polyline& points, double corner_radius);

  double length() const { return length_; }

  /// `arc_length`: m from the start; beyond the ends the path continues straight.
  PathPoint at(double arc_length) const;

  /// Points along the path: the ends of the legs, and the arcs in steps of at most `arc_step` (m).
  Polyline points(double arc_step) const;

 private:
  struct Piece {
    Pose2 start;
    double curvature = 0.0;
    double length = 0.0;
    double arc_length = 0.0;  ///< m along the path at the start of the piece
  };

  void append(const Pose2& start, double curvature, double length);

  std::vector<Piece> pieces_;
  double length_ = 0.0;
};

}  // namespace datmo::simulator
