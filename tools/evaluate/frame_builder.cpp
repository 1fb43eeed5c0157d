// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/frame_builder.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace datmo::evaluation {

namespace {

bool isBefore(const Frame& a, const Frame& b) { return a.stamp < b.stamp; }

/// The track, transformed to the map of the truth by `run_in_truth`.
TrackState moved(const TrackState& track, const Pose2& run_in_truth) {
  TrackState result = track;
  result.box.center = run_in_truth * track.box.center;
  result.velocity = run_in_truth.rotate(track.velocity);
  Eigen::Matrix4d turn = Eigen::Matrix4d::Zero();
  turn.topLeftCorner<2, 2>() = run_in_truth.rotation();
  turn.bottomRightCorner<2, 2>() = run_in_truth.rotation();
  result.covariance = turn * track.covariance * turn.transpose();
  return result;
}

/// Aligns the map of the run with that of the truth.
class MapLayer {
 public:
  MapLayer(const Trajectory& estimated, const std::optional<Alignment>& alignment,
           TrackAlignment kind)
      : estimated_(estimated), alignment_(alignment), kind_(kind) {}

  std::optional<Pose2> runInTruth(Stamp stamp, const Pose2& true_base) const {
    if (kind_ == TrackAlignment::kNone) {
      return Pose2();
    }
    if (kind_ == TrackAlignment::kFirstPose) {
      return alignment_ ? std::make_optional(alignment_->run_in_truth) : std::nullopt;
    }
    const auto base = estimated_.at(stamp);
    return base ? std::make_optional(true_base * base->inverse()) : std::nullopt;
  }

 private:
  const Trajectory& estimated_;
  const std::optional<Alignment>& alignment_;
  TrackAlignment kind_;
};

/// Whether a track outside the region counts nevertheless, because it is on an object that counts.
bool isOnRequired(const TrackState& track, const std::vector<TrueState>& objects,
                  const MatchOptions& options) {
  return std::any_of(objects.begin(), objects.end(), [&](const TrueState& object) {
    return object.duty == Duty::kRequired && matchDistance(object, track, options) <= options.gate;
  });
}

std::vector<TrackState> tracksThatCount(const RecordedTracks& recorded, const Pose2& run_in_truth,
                                        const TrueScene& scene, const TrueScene::View& view,
                                        const ScoreOptions& options) {
  std::vector<TrackState> tracks;
  for (const RecordedTrack& track : recorded.tracks) {
    if (options.moving_tracks_only && !track.moving) {
      continue;
    }
    const TrackState state = moved(track.state, run_in_truth);
    if (scene.isInRegion(view.base_in_map, state.box.center.position()) ||
        isOnRequired(state, view.objects, options.metrics.matching)) {
      tracks.push_back(state);
    }
  }
  return tracks;
}

/// Whether one of the frames, in order of stamp, is within `seconds` of the stamp.
bool isNear(const Frames& frames, Stamp stamp, double seconds) {
  const auto after = std::lower_bound(frames.begin(), frames.end(), Frame{stamp, {}, {}}, isBefore);
  return (after != frames.end() && secondsBetween(stamp, after->stamp) <= seconds) ||
         (after != frames.begin() && secondsBetween((after - 1)->stamp, stamp) <= seconds);
}

Frames silentFrames(const Frames& frames, const TrueScene& scene, double max_silence) {
  Frames silent;
  for (const Stamp stamp : scene.stamps()) {
    if (isNear(frames, stamp, max_silence)) {
      continue;
    }
    if (const auto view = scene.at(stamp)) {
      silent.push_back({stamp, view->objects, {}});
    }
  }
  return silent;
}

/// Total time for which each object has to be found, s.
std::map<std::uint32_t, double> requiredTimes(const Frames& frames, double max_gap) {
  std::map<std::uint32_t, double> times;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const double step = secondsBetween(frames[i - 1].stamp, frames[i].stamp);
    for (const TrueState& object : frames[i].truths) {
      const bool counts = object.duty == Duty::kRequired && step <= max_gap;
      times[object.id] += counts ? step : 0.0;
    }
  }
  return times;
}

void excuseBriefObjects(Frames& frames, const ScoreOptions& options) {
  auto times = requiredTimes(frames, options.max_gap);
  for (Frame& frame : frames) {
    for (TrueState& object : frame.truths) {
      if (times[object.id] < options.truth.min_time_seen) {
        object.duty = Duty::kOptional;
      }
    }
  }
}

}  // namespace

BuiltFrames buildFrames(const std::vector<RecordedTracks>& tracks, const Trajectory& estimated,
                        const std::optional<Alignment>& alignment, const TrueScene& scene,
                        const ScoreOptions& options) {
  const MapLayer layer(estimated, alignment, options.align);
  BuiltFrames built;
  for (const RecordedTracks& recorded : tracks) {
    const auto view = scene.at(recorded.stamp);
    const auto run_in_truth =
        view ? layer.runInTruth(recorded.stamp, view->base_in_map) : std::nullopt;
    if (!run_in_truth) {
      ++built.left_out;
      continue;
    }
    built.frames.push_back({recorded.stamp, view->objects,
                            tracksThatCount(recorded, *run_in_truth, scene, *view, options)});
  }
  if (built.frames.empty()) {
    return built;
  }
  const Frames silent = silentFrames(built.frames, scene, options.max_silence);
  built.frames.insert(built.frames.end(), silent.begin(), silent.end());
  std::sort(built.frames.begin(), built.frames.end(), isBefore);
  excuseBriefObjects(built.frames, options);
  return built;
}

}  // namespace datmo::evaluation
