// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "evaluate/matching.h"
#include "evaluate/state_errors.h"

namespace datmo::evaluation {

/// Scores of one true object, over the frames in which it is required.
struct ObjectScore {
  std::uint32_t id = 0;
  ObjectClass classification = ObjectClass::kUnknown;  ///< in its first frame
  Stamp first;                                         ///< its first frame
  Stamp last;                                          ///< its last frame
  std::size_t required_frames = 0;                     ///< at least 1
  std::size_t tracked_frames = 0;
  std::optional<double> delay;           ///< from the first frame to the first match, s
  std::vector<std::uint32_t> track_ids;  ///< of the tracks that it was matched to, in order of
                                         ///< first match, each once
  StateErrors errors;

  bool found() const { return tracked_frames > 0; }
  /// Share of the frames in which it is matched, 0 to 1.
  double completeness() const;
};

/// Delays until objects were tracked, over those that were found; none: no object.
struct DelayScore {
  std::optional<double> mean;    ///< s
  std::optional<double> median;  ///< s, nearest rank
  std::size_t objects = 0;       ///< that were found
};

DelayScore scoreDelays(const std::vector<ObjectScore>& objects);

/// Every object that is required in some frame, by first frame. `matching` is of these frames.
std::vector<ObjectScore> scoreObjects(const Frames& frames, const Matching& matching);

}  // namespace datmo::evaluation
