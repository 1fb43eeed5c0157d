// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/fusion/earth/local_plane.h"
#include "datmo_fusion/fusion/wire/mapem.h"

namespace datmo {

/// A lane for vehicles that leads into an intersection, in a local plane of east and north.
struct ApproachLane {
  std::int64_t id = 0;
  std::vector<Point2> points;        ///< m, its middle, from the stop line on; two or more
  double width = 0.0;                ///< m; 0: not known
  std::vector<std::int64_t> groups;  ///< of signals, each once
};

struct ApproachLanes {
  std::vector<ApproachLane> lanes;
  std::uint64_t left_out = 0;  ///< lanes into it whose geometry cannot be used
};

/// The lanes of an intersection that vehicles come on. Steps between nodes are to the east and
/// north at its reference point. Throws WireError (`no_position`) where that is not on the earth.
ApproachLanes approachLanes(const MapIntersection& intersection, const LocalPlane& plane);

/// Where something is on a lane.
struct LanePosition {
  double distance = 0.0;  ///< m along it to the stop line; negative: beyond it
  double lateral = 0.0;   ///< m from its middle
  double heading = 0.0;   ///< rad in the plane, of the lane there toward the intersection
  double outside = 0.0;   ///< m beyond the end of what is known of the lane; 0: within it
};

/// The nearest point of a lane. Beyond the stop line and its other end it goes straight on.
LanePosition positionOn(const ApproachLane& lane, const Point2& point);

}  // namespace datmo
