// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "message_samples.h"

#include "datmo_fusion/road/road_model.h"

namespace datmo::samples {

/// A straight road along x: a border of three points on the left at y = 3, one of two on the right
/// at y = -4.
inline RoadModel straightRoad() {
  RoadModel road;
  road.stamp = Stamp::fromSeconds(kStart);
  RoadBorder left;
  left.side = RoadSide::kLeft;
  left.points = {{{0.0, 3.0}, 0.125}, {{10.0, 3.0}, 0.25}, {{20.0, 3.0}, 0.5}};
  left.probability = 0.75;
  left.unseen_for = 0.5;
  RoadBorder right;
  right.side = RoadSide::kRight;
  right.points = {{{-5.0, -4.0}, 0.25}, {{15.0, -4.0}, 0.25}};
  right.probability = 0.5;
  road.borders = {left, right};
  road.intersection_probability = 0.25;
  return road;
}

}  // namespace datmo::samples
