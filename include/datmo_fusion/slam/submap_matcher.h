// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/slam/map_search.h"
#include "datmo_fusion/slam/scan_matcher.h"
#include "datmo_fusion/slam/submap.h"

namespace datmo {

struct SubmapMatcherOptions {
  OccupancyMapOptions map;
  MapSearchOptions search;
  ScanMatcherOptions match;
  double max_step = 1.0;                ///< m
  double position_sigma = 0.05;         ///< m
  double heading_sigma = degrees(0.3);  ///< rad

  SubmapMatcherOptions();
  void visit(OptionVisitor& visitor);
};

/// Finds where one submap lies in another one, within a wide prior.
///
/// MapSearch gives a unique pose or none: if others are possible, too, as along a street of
/// identical houses, there is no loop. From there, all beam ends of the newer submap are matched
/// with the surfaces of the older one (ScanMatcher), to well below the size of a cell. A match that
/// leaves a direction unobserved, or moves away from the search result, is rejected.
class SubmapMatcher {
 public:
  enum class Outcome {
    kFound,
    kAmbiguous,  ///< several such poses, or too little to compare
    kNone,       ///< the submaps do not match
    kNoMatch,    ///< the match does not confirm the search result
  };
  struct Result {
    Outcome outcome = Outcome::kNone;
    PoseWithCovariance newer_in_older;  ///< with kFound
  };

  /// Throws OptionError.
  explicit SubmapMatcher(const Checked<SubmapMatcherOptions>& options);

  /// Matches two submaps; `prior`: of the newer one's frame in that of the older one.
  Result match(const Submap& older, const Submap& newer, const PoseWithCovariance& prior) const;

 private:
  Result refined(const OccupancyMap& older, const Submap& newer,
                 const PoseWithCovariance& found) const;

  SubmapMatcherOptions options_;
  ScanMatcher matcher_;
};

}  // namespace datmo
