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

struct BorderSearchOptions {
  double length = 20.0;  ///< m, of a window
  double width = 1.0;    ///< m

  void visit(OptionVisitor& visitor);
};

/// A straight piece of border, found where no border was known.
struct FoundBorder {
  RoadSide side = RoadSide::kLeft;
  /// Where it begins, m, map frame, beside the pose that the search started from; its heading is
  /// that of the border, as the vehicle drives.
  Pose2 line;
  double length = 0.0;  ///< m
  /// Over where it begins (m, to the left of the line) and its heading (rad).
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double score = 0.0;  ///< of the window
};

/// Looks for a border of the road in windows at rising distances from the vehicle (thesis 3.5).
class BorderSearch {
 public:
  /// Throws OptionError.
  explicit BorderSearch(const BorderSearchOptions& options);

  /// The border on one side of `from` (map frame), from beside it on, as far as the windows reach
  /// in the direction of its heading. Of the thesis: the scanner's pose.
  std::optional<FoundBorder> search(const HitGrid& hits, const Pose2& from, RoadSide side) const;

 private:
  BorderSearchOptions options_;
};

}  // namespace datmo
