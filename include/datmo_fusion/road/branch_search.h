// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/road/passage_grid.h"

namespace datmo {

struct BranchSearchOptions {
  double length = 24.0;  ///< m
  double width = 5.5;    ///< m
  /// m, 0 to 10: distance from the vehicle to the street's center line, at most: the vehicle is
  /// beside a yard of that length only briefly
  double max_shift = 2.0;
  /// rad, 1 to 30 degrees: between the headings that are tried
  double heading_step = degrees(5.0);
  double min_free = 0.9;  ///< 0.1 to 1: minimum share of a street that beams have passed
  /// 0 to 100: additional share that beams must have passed, beyond min_free, for each share of the
  /// length that is blocked, as by a waiting vehicle
  double blocked_weight = 2.0;
  double min_sides = 0.25;  ///< 1
  /// rad, 10 to 360 degrees: free headings that span a wider angle are open space
  double max_angle = degrees(70.0);
  /// rad, 10 to 120 degrees: minimum angle between the headings of two streets
  double min_separation = degrees(70.0);

  void visit(OptionVisitor& visitor);
};

/// A street that leads away from a point.
struct RoadBranch {
  double heading = 0.0;  ///< rad, map frame, middle of the free headings
  double angle = 0.0;    ///< rad, width of the free headings
  /// 0 to 1, share of its length beyond the vehicle's own road with an obstacle beside it, mean of
  /// both sides; maximum over the free headings.
  double sides = 0.0;
};

/// Finds the streets that lead away from a point: corridors as wide as a street and longer than a
/// yard or driveway, that beams have passed and that are free of obstacles, but with obstacles
/// beside them, since what is seen through a gap between parked cars may be open ground without
/// sides. This is independent of the vehicle's heading. A road has two of them, an intersection
/// three or more; a wider free angle is open space rather than a street.
class BranchSearch {
 public:
  /// Throws OptionError.
  explicit BranchSearch(const Checked<BranchSearchOptions>& options) : options_(*options) {}

  /// Returns those that lead away from a point (m, map frame); empty in an open space.
  std::vector<RoadBranch> search(const PassageGrid& grid, const Point2& from) const;

 private:
  /// m to the left of a pose (map frame): middle of the free corridors along it; none if none is
  /// free.
  std::optional<double> freeShift(const PassageGrid& grid, const Pose2& from) const;

  /// Share (0 to 1) of a corridor's length with an obstacle beside it; `axis`: map frame.
  double sidesOf(const PassageGrid& grid, const Pose2& axis) const;

  BranchSearchOptions options_;
};

}  // namespace datmo
