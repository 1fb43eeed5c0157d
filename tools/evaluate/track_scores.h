// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "evaluate/class_scores.h"
#include "evaluate/clear_mot.h"
#include "evaluate/consistency.h"
#include "evaluate/false_movers.h"
#include "evaluate/frame_scores.h"
#include "evaluate/gospa.h"
#include "evaluate/hota.h"
#include "evaluate/identity.h"
#include "evaluate/matching.h"
#include "evaluate/object_scores.h"
#include "evaluate/state_errors.h"
#include "evaluate/thesis_counts.h"

namespace datmo::evaluation {

struct TrackScoreOptions {
  MatchOptions matching;
  GospaOptions gospa;
  double false_mover_speed = 0.5;  ///< m/s

  void visit(OptionVisitor& visitor);
};

/// All scores of the tracks of a run. Scores without samples are none.
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
