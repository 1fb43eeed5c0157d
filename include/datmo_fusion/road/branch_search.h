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
  double length = 24.0;                   ///< m
  double width = 5.5;                     ///< m
  double max_shift = 2.0;                 ///< m
  double heading_step = degrees(5.0);     ///< rad
  double min_free = 0.9;                  ///< 1
  double blocked_weight = 2.0;            ///< 1
  double min_sides = 0.25;                ///< 1
  double max_angle = degrees(70.0);       ///< rad
  double min_separation = degrees(70.0);  ///< rad

  void visit(OptionVisitor& visitor);
};

/// A street that leads away from a point.
struct RoadBranch {
  double heading = 0.0;  ///< rad, map frame, the middle of those in which it is free
  double angle = 0.0;    ///< rad, of all headings in which it is
  /// 0 to 1, share of its length beyond the vehicle's own road beside which something stands, mean
  /// of both sides; the largest of those headings'.
  double sides = 0.0;
};

/// Finds the streets that lead away from a point: corridors as wide as a street and so long that
/// neither a yard nor a driveway is, which beams have passed and in which nothing stands, and
/// beside which something does: what is seen through a gap between parked cars may be open ground,
/// which has no sides. That holds however the vehicle is turned. On a road there are two of them,
/// at an intersection three or more; what is free in a wider angle is open space and no street.
class BranchSearch {
 public:
  /// Throws OptionError.
  explicit BranchSearch(const Checked<BranchSearchOptions>& options) : options_(*options) {}

  /// Those that lead away from a point (m, map frame); none at all in an open space.
  std::vector<RoadBranch> search(const PassageGrid& grid, const Point2& from) const;

 private:
  /// m to the left of a pose (map frame), the middle of those corridors along it that are free;
  /// none: none is.
  std::optional<double> freeShift(const PassageGrid& grid, const Pose2& from) const;

  /// Share (0 to 1) of the length of a corridor beside which something stands; `axis`: map frame.
  double sidesOf(const PassageGrid& grid, const Pose2& axis) const;

  BranchSearchOptions options_;
};

}  // namespace datmo
