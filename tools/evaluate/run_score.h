// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "evaluate/attainable.h"
#include "evaluate/evaluation_data.h"
#include "evaluate/false_detections.h"
#include "evaluate/intersection_score.h"
#include "evaluate/pose_score.h"
#include "evaluate/recorded_data.h"
#include "evaluate/score_options.h"
#include "evaluate/standing_objects.h"
#include "evaluate/track_scores.h"

namespace datmo::evaluation {

/// Thrown if a run and a truth cannot be scored together; the message gives the reason, but names
/// no file.
class ScoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Nearest-rank quantiles over all messages, s.
struct DurationScore {
  double median = 0.0;
  double percentile_99 = 0.0;
  double worst = 0.0;
};

/// Durations of one stage.
struct StageScore {
  DurationScore processing;
  std::optional<DurationScore> latency;  ///< from measurement to result; none: not known
};

/// The vehicle's poses at the stamp of a frame, in the map of the truth.
struct EgoPoses {
  Pose2 truth;
  std::optional<Pose2> estimated;  ///< maps aligned at the first pose
};

/// All scores of a run.
struct RunScore {
  Frames frames;              ///< at least one
  std::vector<EgoPoses> ego;  ///< of each frame
  std::size_t left_out = 0;   ///< messages with tracks outside of the truth or of the poses
  TrackScores tracks;
  std::optional<std::vector<ComparedDelay>> delays;  ///< of tracks.objects; none: without scans
  StateErrors near_errors;  ///< of tracks, within ScoreOptions::near_range of the true vehicle
  std::vector<StandingObject> standing_objects;
  std::optional<PoseScore> pose;                      ///< none: the run has no poses
  std::optional<FalseDetections> false_detections;    ///< none: the run has no detections
  std::optional<IntersectionScore> intersections;     ///< none: the truth has no roads
  std::map<std::string, StageScore> stages;           ///< empty: the run has no timing
  std::map<std::uint32_t, std::string> truth_labels;  ///< by id
};

/// Scores a run against a truth; with the scans of the recording (in order of stamp, none: not
/// requested) also its delays relative to the attainable minimum. Pure. Throws OptionError, and
/// ScoreError if their stamps do not overlap.
RunScore scoreRun(const RecordedRun& run, const RecordedTruth& truth, const ScoreOptions& options,
                  const std::optional<std::vector<Scan>>& scans = std::nullopt);

}  // namespace datmo::evaluation
