// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/road/followed_border.h"
#include "datmo_fusion/road/road_model.h"

namespace datmo {

struct BorderPublishingOptions {
  double ahead = 40.0;      ///< m
  double behind = 10.0;     ///< m
  double spacing = 1.0;     ///< m
  double max_sigma = 1.0;   ///< m
  double min_length = 3.0;  ///< m

  void visit(OptionVisitor& visitor);
};

/// Returns the borders of the road: at each station along the vehicle's heading the innermost
/// confirmed line that is a border there.
std::vector<RoadBorder> publishedBorders(const std::vector<FollowedBorder>& borders,
                                         const Pose2& vehicle,
                                         const BorderPublishingOptions& options);

}  // namespace datmo
