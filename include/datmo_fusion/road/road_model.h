// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// The side of the vehicle on which a border runs; values as in RoadBorder.msg.
enum class RoadSide : std::uint8_t { kLeft, kRight };

/// Returns how far to the outside of the road something is that is this far to the left.
inline double outwardOf(RoadSide side, double to_left) {
  return side == RoadSide::kLeft ? to_left : -to_left;
}

/// Returns one lower-case word.
const char* nameOf(RoadSide side);

/// A point of a border and how well it is known.
struct BorderPoint {
  Point2 position = Point2::Zero();  ///< m, fixed frame (map)
  double sigma = 0.0;                ///< m, standard deviation across the border
};

/// One section of a border of the road: a curb, or the road side of a row of parked cars.
struct RoadBorder {
  RoadSide side = RoadSide::kLeft;
  /// It bounds a street that opens into the vehicle's on `side`: what lies beyond it may be the
  /// vehicle's own road.
  bool side_street = false;
  /// In driving direction, at least two. Where nothing bounds the road (a side street) the border
  /// ends; another section may begin behind it.
  std::vector<BorderPoint> points;
  double probability = 0.0;  ///< 0 to 1, that there is a border
  double unseen_for = 0.0;   ///< s since a scan last observed some of it
};

/// The road around the vehicle at one stamp (thesis 2.4, figure 2.10).
struct RoadModel {
  Stamp stamp;
  std::vector<RoadBorder> borders;  ///< any number per side; those of its own road do not overlap
  double intersection_probability = 0.0;  ///< 0 to 1, that the vehicle is at an intersection
  bool at_intersection = false;
};

}  // namespace datmo
