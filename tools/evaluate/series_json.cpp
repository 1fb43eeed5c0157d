// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/series_json.h"

#include <cmath>
#include <map>

#include "evaluate/json_number.h"

#include "datmo_fusion/assignment/assignment.h"

namespace datmo::evaluation {

namespace {

using nlohmann::json;

/// Millimeters and milliseconds, to keep the report small.
double rounded(double value) { return std::round(1e3 * value) / 1e3; }

template <typename Items, typename Value>
json listOf(const Items& items, const Value& value) {
  json list = json::array();
  for (const auto& item : items) {
    list.push_back(value(item));
  }
  return list;
}

double timeOf(const RunScore& score, const Frame& frame) {
  return rounded(secondsBetween(score.frames.front().stamp, frame.stamp));
}

void addPosition(json& path, double time, const Point2& position) {
  path["time_s"].push_back(time);
  path["x_m"].push_back(rounded(position.x()));
  path["y_m"].push_back(rounded(position.y()));
}

json valuesOf(const std::map<std::uint32_t, json>& paths) {
  return listOf(paths, [](const auto& entry) { return entry.second; });
}

/// Id of the track that is matched to a true object of the frame, or null.
json trackId(const Frame& frame, const FrameMatching& matching, std::size_t truth) {
  const int track = matching.track_of_truth.at(truth);
  return track == kUnassigned ? json() : json(frame.tracks.at(static_cast<std::size_t>(track)).id);
}

json truePaths(const RunScore& score) {
  std::map<std::uint32_t, json> paths;
  for (std::size_t i = 0; i < score.frames.size(); ++i) {
    const Frame& frame = score.frames[i];
    for (std::size_t truth = 0; truth < frame.truths.size(); ++truth) {
      const TrueState& object = frame.truths[truth];
      json& path = paths[object.id];
      path["id"] = object.id;
      path["label"] = score.truth_labels.at(object.id);
      addPosition(path, timeOf(score, frame), object.box.center.position());
      path["track_id"].push_back(trackId(frame, score.tracks.matching.at(i), truth));
      path["required"].push_back(object.duty == Duty::kRequired);
    }
  }
  return valuesOf(paths);
}

json trackPaths(const RunScore& score) {
  std::map<std::uint32_t, json> paths;
  for (const Frame& frame : score.frames) {
    for (const TrackState& track : frame.tracks) {
      json& path = paths[track.id];
      path["id"] = track.id;
      addPosition(path, timeOf(score, frame), track.box.center.position());
    }
  }
  return valuesOf(paths);
}

json trueEgo(const RunScore& score) {
  const auto& ego = score.ego;
  return {{"x_m", listOf(ego, [](const EgoPoses& poses) { return rounded(poses.truth.x()); })},
          {"y_m", listOf(ego, [](const EgoPoses& poses) { return rounded(poses.truth.y()); })}};
}

json estimatedEgo(const RunScore& score) {
  const auto coordinate = [&score](int axis) {
    return listOf(score.ego, [axis](const EgoPoses& poses) {
      return poses.estimated ? json(rounded(poses.estimated->position()(axis))) : json();
    });
  };
  return {{"x_m", coordinate(0)}, {"y_m", coordinate(1)}};
}

json poseErrors(const RunScore& score) {
  return listOf(score.ego, [](const EgoPoses& poses) {
    return poses.estimated
               ? json(rounded((poses.estimated->position() - poses.truth.position()).norm()))
               : json();
  });
}

}  // namespace

json seriesJson(const RunScore& score) {
  const auto& scores = score.tracks.frames;
  const auto time = [&score](const Frame& frame) { return timeOf(score, frame); };
  return {{"time_s", listOf(score.frames, time)},
          {"true_objects", listOf(scores, [](const FrameScore& frame) { return frame.required; })},
          {"tracked", listOf(scores, [](const FrameScore& frame) { return frame.matches; })},
          {"missed", listOf(scores, [](const FrameScore& frame) { return frame.misses(); })},
          {"false", listOf(scores, [](const FrameScore& frame) { return frame.false_positives; })},
          {"position_error_m",
           listOf(scores, [](const FrameScore& frame) { return orNull(frame.position_error); })},
          {"velocity_error_mps",
           listOf(scores, [](const FrameScore& frame) { return orNull(frame.velocity_error); })},
          {"gospa_m",
           listOf(score.tracks.gospa_frames, [](const Gospa& frame) { return frame.total; })},
          {"pose_error_m", poseErrors(score)},
          {"true_paths", truePaths(score)},
          {"track_paths", trackPaths(score)},
          {"ego_true", trueEgo(score)},
          {"ego_estimated", estimatedEgo(score)}};
}

}  // namespace datmo::evaluation
