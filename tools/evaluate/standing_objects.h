// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "evaluate/matching.h"
#include "evaluate/true_scene.h"

namespace datmo::evaluation {

/// A true object that never moves, such as a parked car. A track on it is false.
struct StandingObject {
  std::uint32_t id = 0;
  ObjectClass classification = ObjectClass::kUnknown;
  std::size_t frames = 0;          ///< in which it is visible and in the region
  std::size_t tracked_frames = 0;  ///< of them, those with a false track on it
};

/// All of them, by id. A false track is on the nearest one within the gate. `matching` is of these
/// frames and options.
std::vector<StandingObject> scoreStandingObjects(const Frames& frames, const Matching& matching,
                                                 const TrueScene& scene,
                                                 const MatchOptions& options);

}  // namespace datmo::evaluation
