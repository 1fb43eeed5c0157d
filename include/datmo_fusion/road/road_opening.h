// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/road/border_presence.h"
#include "datmo_fusion/road/road_model.h"

namespace datmo {

struct RoadOpeningOptions {
  double min_length = 6.0;   ///< m
  double max_length = 40.0;  ///< m

  void visit(OptionVisitor& visitor);
};

/// A stretch along which nothing bounds the road: where a street may open into it.
struct RoadOpening {
  RoadSide side = RoadSide::kLeft;
  Pose2 middle;         ///< map frame, on the line of the border; its heading is out of the road
  double length = 0.0;  ///< m, along the road
};

/// The openings about a vehicle: runs of stations where rather no border is, behind one where a
/// border is (a road whose border was never seen has none). The road is taken to be straight from
/// the vehicle on; `borders` (map frame) give how far from it the openings lie.
std::vector<RoadOpening> openingsOf(const BorderPresence& presence,
                                    const std::vector<RoadBorder>& borders,
                                    const Pose2& base_in_map, const RoadOpeningOptions& options);

}  // namespace datmo
