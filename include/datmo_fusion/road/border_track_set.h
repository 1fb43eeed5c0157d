// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/grid/hit_grid.h"
#include "datmo_fusion/road/border_search.h"
#include "datmo_fusion/road/followed_border.h"

namespace datmo {

struct BorderTrackSetOptions {
  FollowedBorderOptions border;
  /// m, -50 to 100: distances ahead of the scanner at which searches begin
  std::vector<double> search_from{0.0, 12.0};

  void visit(OptionVisitor& visitor);
};

/// All confirmed and candidate border lines, on both sides.
class BorderTrackSet {
 public:
  explicit BorderTrackSet(const BorderTrackSetOptions& options) : options_(options) {}

  const std::vector<FollowedBorder>& borders() const { return borders_; }

  /// Advances all lines to the next scan, deletes those that have ended, and searches for new ones
  /// among hits that no line explains: on one side and from one station per scan, in rotation.
  void update(const BorderScan& scan, const HitGrid& hits, const BorderSearch& search);

  void clear();

 private:
  void follow(const BorderScan& scan);
  void removeDuplicates();
  void searchFrom(const HitGrid& hits, const BorderSearch& search, const Pose2& from,
                  RoadSide side);
  const FollowedBorder* alongside(const FoundBorder& found) const;

  BorderTrackSetOptions options_;
  std::vector<FollowedBorder> borders_;
  std::vector<double> nearest_;   ///< m, distance from each beam's end to the nearest line
  std::vector<bool> is_nearest_;  ///< for one line: it is the nearest
  std::size_t turn_ = 0;
};

}  // namespace datmo
