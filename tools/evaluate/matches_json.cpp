// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/matches_json.h"

namespace datmo::evaluation {

namespace {

using nlohmann::json;

json matchJson(const TrueState& truth, const TrackState& track, const MatchOptions& options) {
  return {{"truth_id", truth.id},
          {"track_id", track.id},
          {"distance_m", matchDistance(truth, track, options)},
          {"required", truth.duty == Duty::kRequired}};
}

void addObjects(const Frame& frame, const FrameMatching& matching, const MatchOptions& options,
                json& result) {
  for (std::size_t i = 0; i < frame.truths.size(); ++i) {
    const TrueState& truth = frame.truths[i];
    const int track = matching.track_of_truth[i];
    if (track != kUnassigned) {
      const TrackState& matched = frame.tracks[static_cast<std::size_t>(track)];
      result["matches"].push_back(matchJson(truth, matched, options));
    } else if (truth.duty == Duty::kRequired) {
      result["missed"].push_back(truth.id);
    }
  }
}

void addTracks(const Frame& frame, const FrameMatching& matching, json& result) {
  for (std::size_t i = 0; i < frame.tracks.size(); ++i) {
    if (matching.verdicts[i] == Verdict::kFalse) {
      result["false"].push_back(frame.tracks[i].id);
    } else if (matching.verdicts[i] == Verdict::kNeutral) {
      result["neutral"].push_back(frame.tracks[i].id);
    }
  }
}

json frameJson(const Frame& frame, const FrameMatching& matching, const MatchOptions& options) {
  json result = {{"stamp_ns", frame.stamp.nanoseconds}};
  for (const char* list : {"matches", "missed", "false", "neutral", "switches"}) {
    result[list] = json::array();
  }
  addObjects(frame, matching, options, result);
  addTracks(frame, matching, result);
  return result;
}

}  // namespace

json matchesJson(const RunScore& score, const MatchOptions& options) {
  json frames = json::array();
  for (std::size_t i = 0; i < score.frames.size(); ++i) {
    frames.push_back(frameJson(score.frames[i], score.tracks.matching.at(i), options));
  }
  for (const IdSwitch& change : score.tracks.clear_mot.switches) {
    frames.at(change.frame)["switches"].push_back(
        {{"truth_id", change.truth}, {"from", change.from}, {"to", change.to}});
  }
  return {{"format", kMatchesFormat}, {"frames", frames}};
}

}  // namespace datmo::evaluation
