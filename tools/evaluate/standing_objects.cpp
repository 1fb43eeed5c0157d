// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/standing_objects.h"

#include <map>
#include <set>

namespace datmo::evaluation {

namespace {

/// Ids of the objects with a false track of the frame on them.
std::set<std::uint32_t> idsUnderFalseTracks(const std::vector<TrueState>& standing,
                                            const Frame& frame, const FrameMatching& matching,
                                            const MatchOptions& options) {
  std::set<std::uint32_t> ids;
  for (std::size_t track = 0; track < frame.tracks.size(); ++track) {
    if (matching.verdicts.at(track) != Verdict::kFalse) {
      continue;
    }
    const TrueState* nearest = nullptr;
    double min = options.gate;
    for (const TrueState& object : standing) {
      const double distance = matchDistance(object, frame.tracks[track], options);
      if (distance <= min) {
        nearest = &object;
        min = distance;
      }
    }
    if (nearest != nullptr) {
      ids.insert(nearest->id);
    }
  }
  return ids;
}

}  // namespace

std::vector<StandingObject> scoreStandingObjects(const Frames& frames, const Matching& matching,
                                                 const TrueScene& scene,
                                                 const MatchOptions& options) {
  std::map<std::uint32_t, StandingObject> objects;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::vector<TrueState> standing = scene.standingAt(frames[i].stamp);
    const auto tracked = idsUnderFalseTracks(standing, frames[i], matching.at(i), options);
    for (const TrueState& state : standing) {
      StandingObject& object = objects[state.id];
      object.id = state.id;
      object.classification = state.classification;
      ++object.frames;
      object.tracked_frames += tracked.count(state.id);
    }
  }
  std::vector<StandingObject> result;
  for (const auto& entry : objects) {
    result.push_back(entry.second);
  }
  return result;
}

}  // namespace datmo::evaluation
