// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/grid/hit_grid.h"
#include "datmo_fusion/road/road_model.h"

namespace datmo {

/// Score of a window: the share of its sections that have a hit, or the number of its hits.
enum class BorderScore { kShare, kHits };

/// Which window is chosen of those that score high enough.
enum class BorderChoice { kFirst, kHighest };

struct BorderSearchOptions {
  double length = 20.0;  ///< m, of a window
  double width = 1.0;    ///< m
  /// m, 0 to 50: from the vehicle to the center line of the first window (thesis 3.5: 1)
  double first_distance = 1.0;
  double step = 0.9;  ///< m, between consecutive windows
  int left_windows = 25;
  int right_windows = 15;
  double heading_range = 0.15;  ///< rad, to either side
  /// rad, 0.005 to 0.5: angle between rotated windows: a line at half of it to a window should not
  /// leave the window
  double heading_step = 0.05;
  int sections = 20;
  BorderScore score = BorderScore::kShare;
  double min_share = 0.4;  ///< 0 to 1
  double min_hits = 500.0;
  BorderChoice take = BorderChoice::kFirst;
  /// m, 0.01 to 2: standard deviation of the hits about the border, by range noise
  double hit_sigma = 0.2;
  /// m, 0 to 2: standard deviation of the border about a straight line
  double shape_sigma = 0.1;

  void visit(OptionVisitor& visitor);
};

/// A straight piece of border, found where none was known.
struct FoundBorder {
  RoadSide side = RoadSide::kLeft;
  /// Start point, m, map frame, beside the pose that the search started from; its heading is the
  /// direction of the border in driving direction.
  Pose2 line;
  double length = 0.0;  ///< m
  /// Of the start point's lateral position (m, to the left of the line) and the heading (rad).
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double score = 0.0;  ///< of the window
};

/// Returns a found border from start to end, points at most `spacing` (m, more than 0) apart.
std::vector<BorderPoint> pointsOf(const FoundBorder& found, double spacing);

/// Searches for a road border in windows at increasing distances from the vehicle (thesis 3.5).
class BorderSearch {
 public:
  /// Throws OptionError.
  explicit BorderSearch(const Checked<BorderSearchOptions>& options);

  /// Returns the border on one side of `from` (map frame), starting beside it, within the length of
  /// the windows along its heading. In the thesis `from` is the scanner's pose.
  std::optional<FoundBorder> search(const HitGrid& hits, const Pose2& from, RoadSide side) const;

 private:
  BorderSearchOptions options_;
};

}  // namespace datmo
