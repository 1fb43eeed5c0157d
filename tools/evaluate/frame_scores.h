// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "evaluate/matching.h"

namespace datmo::evaluation {

/// Scores of one frame, for plots over time.
struct FrameScore {
  Stamp stamp;
  std::size_t required = 0;              ///< true objects
  std::size_t matches = 0;               ///< of them, those with a track
  std::size_t false_positives = 0;       ///< tracks of no object
  std::optional<double> position_error;  ///< root mean square over the matches, m; none: no match
  std::optional<double> velocity_error;  ///< likewise, m/s

  std::size_t misses() const { return required - matches; }
};

/// One for each frame. `matching` is of these frames.
std::vector<FrameScore> scoreFrames(const Frames& frames, const Matching& matching);

}  // namespace datmo::evaluation
