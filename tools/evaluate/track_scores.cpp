// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/track_scores.h"

#include "evaluate/scored_run.h"

#include "datmo_fusion/slam/odometry_buffer.h"

namespace datmo::evaluation {

void TrackScoreOptions::visit(OptionVisitor& visitor) {
  visitor.group("matching", [&] { matching.visit(visitor); });
  visitor.group("gospa", [&] { gospa.visit(visitor); });
  visitor.number({"false_mover_speed", "m/s",
                  "a false track counts as a false mover if it is faster than half a slow walk"},
                 false_mover_speed, {0.0, kMaxSpeed});
}

TrackScores scoreTracks(const Frames& frames, const TrackScoreOptions& options) {
  checkOptions(options);
  TrackScores scores;
  scores.matching = matchFrames(frames, options.matching);
  scores.frames = scoreFrames(frames, scores.matching);
  scores.clear_mot = scoreClearMot(frames, scores.matching, options.matching);
  scores.false_movers = countFalseMovers(frames, scores.matching, options.false_mover_speed);
  const ScoredRun run = scoredRun(frames, scores.matching);
  scores.identity = scoreIdentity(run);
  scores.hota = scoreHota(run, options.matching.gate);
  scores.gospa_frames = gospaOfFrames(frames, scores.matching, options.gospa);
  scores.gospa = meanGospa(scores.gospa_frames);
  scores.errors = scoreStateErrors(frames, scores.matching);
  scores.consistency = scoreConsistency(frames, scores.matching);
  scores.classes = scoreClasses(frames, scores.matching);
  scores.objects = scoreObjects(frames, scores.matching);
  scores.delay = scoreDelays(scores.objects);
  scores.thesis = countAsThesis(frames, scores.matching);
  return scores;
}

}  // namespace datmo::evaluation
