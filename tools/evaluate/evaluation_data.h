// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo::evaluation {

/// Whether a true object has to be found.
enum class Duty : std::uint8_t {
  kRequired,  ///< it moves, is visible, and is in the scored region
  kOptional,  ///< it is outside these limits: a track on it is neither right nor wrong
};

/// One true object at one stamp; map frame of the truth.
struct TrueState {
  std::uint32_t id = 0;
  ObjectClass classification = ObjectClass::kUnknown;
  Box2 box;                          ///< m, rad
  Point2 velocity = Point2::Zero();  ///< m/s
  Duty duty = Duty::kRequired;
};

/// One published track at one stamp, transformed to the map frame of the truth.
struct TrackState {
  std::uint32_t id = 0;
  ObjectClass classification = ObjectClass::kUnknown;
  Box2 box;                                              ///< m, rad
  Point2 velocity = Point2::Zero();                      ///< m/s
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< of x, y (m), vx, vy (m/s)
  std::size_t sensors = 1;                               ///< that saw it last
};

/// What was true and what was published at one stamp.
struct Frame {
  Stamp stamp;
  std::vector<TrueState> truths;
  std::vector<TrackState> tracks;
};

/// A run, in order of stamp. No id occurs twice in one frame.
using Frames = std::vector<Frame>;

}  // namespace datmo::evaluation
