// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/run_score.h"

#include <sstream>
#include <utility>

#include "evaluate/frame_builder.h"

#include "datmo_fusion/common/quantile.h"

namespace datmo::evaluation {

namespace {

/// From the first stamp to the last; `recorded`: at least one.
template <typename Recorded>
std::string span(const std::string& what, const std::vector<Recorded>& recorded) {
  std::ostringstream text;
  text.precision(3);
  text << std::fixed << what << " from " << recorded.front().stamp.seconds() << " s to "
       << recorded.back().stamp.seconds() << " s";
  return text.str();
}

[[noreturn]] void failForOverlap(const RecordedRun& run, const RecordedTruth& truth) {
  std::string spans = span("tracks", run.tracks);
  spans += run.poses.empty() ? "" : ", " + span("poses", run.poses);
  spans += ", " + span("true objects", truth.objects) + ", " + span("true poses", truth.poses);
  throw ScoreError("no stamp that all data cover: " + spans);
}

DurationScore scoreDurations(const std::vector<double>& seconds) {
  return {quantile(seconds, 0.5), quantile(seconds, 0.99), quantile(seconds, 1.0)};
}

std::map<std::string, StageScore> scoreStages(
    const std::map<std::string, StageDurations>& durations) {
  std::map<std::string, StageScore> scores;
  for (const auto& [stage, seconds] : durations) {
    StageScore& score = scores[stage];
    score.processing = scoreDurations(seconds.processing);
    if (!seconds.latency.empty()) {
      score.latency = scoreDurations(seconds.latency);
    }
  }
  return scores;
}

std::vector<EgoPoses> egoPoses(const Frames& frames, const Trajectory& truth,
                               const Trajectory& estimated,
                               const std::optional<Alignment>& alignment) {
  std::vector<EgoPoses> ego;
  for (const Frame& frame : frames) {
    EgoPoses poses{truth.at(frame.stamp).value(), std::nullopt};
    if (const auto pose = estimated.at(frame.stamp); pose && alignment) {
      poses.estimated = alignment->run_in_truth * *pose;
    }
    ego.push_back(poses);
  }
  return ego;
}

StateErrors nearErrors(const Frames& frames, const Matching& matching,
                       const std::vector<EgoPoses>& ego, double range) {
  std::vector<Point2> positions;
  for (const EgoPoses& poses : ego) {
    positions.push_back(poses.truth.position());
  }
  return scoreNearErrors(frames, matching, positions, range);
}

std::map<std::uint32_t, std::string> labelsOf(const RecordedTruth& truth) {
  std::map<std::uint32_t, std::string> labels;
  for (const RecordedObjects& objects : truth.objects) {
    for (const RecordedObject& object : objects.objects) {
      labels.emplace(object.state.id, object.label);
    }
  }
  return labels;
}

}  // namespace

RunScore scoreRun(const RecordedRun& run, const RecordedTruth& truth, const ScoreOptions& options,
                  const std::optional<std::vector<Scan>>& scans) {
  checkOptions(options);
  const TrueScene scene(truth, options);
  const Trajectory estimated(run.poses, options.max_gap);
  const auto alignment = alignAtFirstPose(estimated, scene.trajectory());
  BuiltFrames built = buildFrames(run.tracks, estimated, alignment, scene, options);
  if (built.frames.empty()) {
    failForOverlap(run, truth);
  }
  RunScore score;
  score.ego = egoPoses(built.frames, scene.trajectory(), estimated, alignment);
  score.left_out = built.left_out;
  score.tracks = scoreTracks(built.frames, options.metrics);
  if (scans) {
    score.delays = compareDelays(score.tracks.objects,
                                 attainableMotions(*scans, scene, options.attainable), *scans);
  }
  score.near_errors =
      nearErrors(built.frames, score.tracks.matching, score.ego, options.near_range);
  score.standing_objects =
      scoreStandingObjects(built.frames, score.tracks.matching, scene, options.metrics.matching);
  score.frames = std::move(built.frames);
  score.pose = scorePoses(estimated, scene.trajectory());
  if (run.detections) {
    score.false_detections = countFalseDetections(*run.detections, scene, options);
  }
  if (truth.intersections) {
    score.intersections =
        scoreIntersections(*truth.intersections, run.intersections, options.intersection_merge_gap);
  }
  score.stages = scoreStages(run.durations);
  score.truth_labels = labelsOf(truth);
  return score;
}

}  // namespace datmo::evaluation
