// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/false_movers.h"

#include <algorithm>

namespace datmo::evaluation {

std::optional<double> FalseMovers::perFrame() const {
  if (frames == 0) {
    return std::nullopt;
  }
  return static_cast<double>(tracks) / static_cast<double>(frames);
}

FalseMovers countFalseMovers(const Frames& frames, const Matching& matching, double min_speed) {
  FalseMovers result;
  result.frames = frames.size();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto& candidates = matching[i].candidates;
    for (std::size_t track = 0; track < frames[i].tracks.size(); ++track) {
      const bool near = std::any_of(candidates.begin(), candidates.end(),
                                    [&](const Candidate& pair) { return pair.track == track; });
      const bool fast = frames[i].tracks[track].velocity.norm() > min_speed;
      result.tracks += fast && !near ? 1 : 0;
    }
  }
  return result;
}

}  // namespace datmo::evaluation
