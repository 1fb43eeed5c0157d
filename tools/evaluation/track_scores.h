// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "evaluation/class_scores.h"
#include "evaluation/clear_mot.h"
#include "evaluation/consistency.h"
#include "evaluation/false_movers.h"
#include "evaluation/frame_scores.h"
#include "evaluation/gospa.h"
#include "evaluation/hota.h"
#include "evaluation/identity.h"
#include "evaluation/matching.h"
#include "evaluation/object_scores.h"
#include "evaluation/state_errors.h"
#include "evaluation/thesis_counts.h"

namespace datmo::evaluation {

struct TrackScoreOptions {
  MatchOptions matching;
  GospaOptions gospa;
  double false_mover_speed = 0.5;  ///< m/s

  void visit(OptionVisitor& visitor);
};

/// Everything that is known about the tracks of a run. What has no sample is none.
struct TrackScores {
  Matching matching;                ///< of each frame
  std::vector<FrameScore> frames;   ///< of each frame
  std::vector<Gospa> gospa_frames;  ///< of each frame
  ClearMot clear_mot;
  FalseMovers false_movers;
  IdentityScores identity;
  HotaScores hota;
  std::optional<Gospa> gospa;  ///< mean over the frames
  StateErrors errors;
  TrackConsistency consistency;
  ClassScores classes;
  std::vector<ObjectScore> objects;
  DelayScore delay;
  ThesisCounts thesis;
};

/// Scores a run by all metrics. Pure: the same frames give the same scores. Throws OptionError for
/// options out of their bounds.
TrackScores scoreTracks(const Frames& frames, const TrackScoreOptions& options);

}  // namespace datmo::evaluation
