// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/class_scores.h"

namespace datmo::evaluation {

namespace {

void add(ObjectClass truth, ObjectClass track, ClassShare& share) {
  ++share.frames;
  share.right += track == truth ? 1 : 0;
  share.silent += track == ObjectClass::kUnknown ? 1 : 0;
}

}  // namespace

std::optional<double> ClassShare::share() const {
  if (frames == 0) {
    return std::nullopt;
  }
  return static_cast<double>(right) / static_cast<double>(frames);
}

ClassScores scoreClasses(const Frames& frames, const Matching& matching) {
  ClassScores scores;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    forEachHit(frames[i], matching[i], [&](const TrueState& truth, const TrackState& track) {
      if (truth.classification != ObjectClass::kUnknown) {
        add(truth.classification, track.classification, scores.all);
        add(truth.classification, track.classification, scores.by_class[truth.classification]);
      }
    });
  }
  return scores;
}

}  // namespace datmo::evaluation
