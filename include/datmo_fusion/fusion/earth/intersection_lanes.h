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
  std::vector<Point2> points;        ///< m, center line, starting at the stop line; two or more
  double width = 0.0;                ///< m; 0: unknown
  std::vector<std::int64_t> groups;  ///< signal groups, each once
};

struct ApproachLanes {
  std::vector<ApproachLane> lanes;
  std::uint64_t left_out = 0;  ///< lanes into it with unusable geometry
};

/// Returns the vehicle lanes that lead into an intersection. Node offsets are east and north of its
/// reference point. Throws WireError (`no_position`) if the reference point is not a valid position
/// on the earth.
ApproachLanes approachLanes(const MapIntersection& intersection, const LocalPlane& plane);

/// A position relative to a lane.
struct LanePosition {
  double distance = 0.0;  ///< m along the lane to the stop line; negative: beyond it
  double lateral = 0.0;   ///< m from the center line
  double heading = 0.0;   ///< rad in the plane, of the lane at that point toward the intersection
  double outside = 0.0;   ///< m beyond the known end of the lane; 0: within it
};

/// Returns the nearest point of a lane. The lane is extended straight at both ends.
LanePosition positionOn(const ApproachLane& lane, const Point2& point);

}  // namespace datmo
