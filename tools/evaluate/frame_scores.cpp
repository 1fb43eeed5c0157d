// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/frame_scores.h"

#include "evaluate/state_errors.h"

namespace datmo::evaluation {

namespace {

FrameScore scoreFrame(const Frame& frame, const FrameMatching& matching) {
  FrameScore score;
  score.stamp = frame.stamp;
  for (const TrueState& truth : frame.truths) {
    score.required += truth.duty == Duty::kRequired ? 1 : 0;
  }
  score.false_positives = matching.falseTracks();
  StateErrorSum sum;
  forEachHit(frame, matching,
             [&sum](const TrueState& truth, const TrackState& track) { sum.add(truth, track); });
  const StateErrors errors = sum.result();
  score.matches = errors.samples;
  score.position_error = errors.position;
  score.velocity_error = errors.velocity;
  return score;
}

}  // namespace

std::vector<FrameScore> scoreFrames(const Frames& frames, const Matching& matching) {
  std::vector<FrameScore> result;
  result.reserve(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    result.push_back(scoreFrame(frames[i], matching[i]));
  }
  return result;
}

}  // namespace datmo::evaluation
