// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "datmo_fusion/grid/ray_walk.h"

namespace datmo {

/// A beam that diverges from a point symmetrically about its axis.
struct Beam {
  Point2 from = Point2::Zero();   ///< m
  Point2 along = Point2::Zero();  ///< m, from `from` to its end
  double range = 0.0;             ///< m, length of `along`
  double width = 0.0;             ///< rad, opening angle; 0: a line
};

/// Calls `visit(Point2 to)` with the end of each line of a fan that covers the beam, from its right
/// edge to its left one; neighboring ends are at most one cell apart.
template <typename Visit>
void forEachLine(const GridWindow& window, const Beam& beam, Visit&& visit) {
  const double spread = beam.width * beam.range;
  const int lines = 1 + static_cast<int>(std::ceil(spread / window.cell_size));
  for (int line = 0; line < lines; ++line) {
    const double turn =
        lines == 1 ? 0.0 : beam.width * (static_cast<double>(line) / (lines - 1) - 0.5);
    visit(beam.from + Eigen::Rotation2Dd(turn) * beam.along);
  }
}

}  // namespace datmo
