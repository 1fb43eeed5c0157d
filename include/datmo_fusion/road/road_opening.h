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

/// A section without a border, where a street may open into the road.
struct RoadOpening {
  RoadSide side = RoadSide::kLeft;
  Pose2 middle;         ///< map frame, on the line of the border; heading away from the road
  double length = 0.0;  ///< m, along the road
};

/// Returns the openings around a vehicle: runs of stations that probably have no border, ahead of
/// some station that has one (a road whose border was never observed has none). The road is assumed
/// straight from the vehicle on; `borders` (map frame) give the openings' lateral distance.
std::vector<RoadOpening> openingsOf(const BorderPresence& presence,
                                    const std::vector<RoadBorder>& borders,
                                    const Pose2& base_in_map, const RoadOpeningOptions& options);

}  // namespace datmo
