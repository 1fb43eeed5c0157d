// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/thesis_counts.h"

#include <cstdint>
#include <map>

#include "evaluate/object_scores.h"

namespace datmo::evaluation {

namespace {

constexpr std::size_t kConfirmingSensors = 2;  // thesis 3.4.2: lidar and stereo

/// Verdicts of one track in its frames.
struct TrackLife {
  std::size_t frames = 0;
  std::size_t neutral_frames = 0;
  std::size_t false_frames = 0;
  bool confirmed = false;

  bool isScored() const { return neutral_frames < frames; }
  bool isFalse() const { return 2 * false_frames > frames; }
};

std::map<std::uint32_t, TrackLife> livesOf(const Frames& frames, const Matching& matching) {
  std::map<std::uint32_t, TrackLife> lives;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (std::size_t j = 0; j < frames[i].tracks.size(); ++j) {
      TrackLife& life = lives[frames[i].tracks[j].id];
      ++life.frames;
      life.neutral_frames += matching[i].verdicts[j] == Verdict::kNeutral ? 1 : 0;
      life.false_frames += matching[i].verdicts[j] == Verdict::kFalse ? 1 : 0;
      life.confirmed = life.confirmed || frames[i].tracks[j].sensors >= kConfirmingSensors;
    }
  }
  return lives;
}

}  // namespace

ThesisCounts countAsThesis(const Frames& frames, const Matching& matching) {
  ThesisCounts counts;
  for (const ObjectScore& object : scoreObjects(frames, matching)) {
    ++counts.moving_objects;
    counts.missed_objects += object.found() ? 0 : 1;
  }
  for (const auto& [id, life] : livesOf(frames, matching)) {
    if (!life.isScored()) {
      continue;
    }
    ++counts.tracks;
    counts.false_tracks += life.isFalse() ? 1 : 0;
    counts.confirmed_tracks += life.confirmed ? 1 : 0;
    counts.confirmed_true_tracks += life.confirmed && !life.isFalse() ? 1 : 0;
  }
  return counts;
}

}  // namespace datmo::evaluation
