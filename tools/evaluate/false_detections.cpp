// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/false_detections.h"

#include <algorithm>

namespace datmo::evaluation {

namespace {

/// A position in the map where something static was last reported as moving.
struct Episode {
  Stamp last;
  Point2 position;
};

/// Counts positions, not detections.
class Episodes {
 public:
  Episodes(double gate, double max_gap) : gate_(gate), max_gap_(max_gap) {}

  void add(Stamp stamp, const Point2& position) {
    const auto known = std::find_if(open_.begin(), open_.end(), [&](const Episode& episode) {
      return (episode.position - position).norm() <= gate_;
    });
    if (known != open_.end()) {
      *known = {stamp, position};
    } else {
      open_.push_back({stamp, position});
      ++count_;
    }
  }

  void closeOld(Stamp now) {
    open_.erase(std::remove_if(open_.begin(), open_.end(),
                               [&](const Episode& episode) {
                                 return secondsBetween(episode.last, now) > max_gap_;
                               }),
                open_.end());
  }

  std::size_t count() const { return count_; }

 private:
  double gate_;
  double max_gap_;
  std::vector<Episode> open_;
  std::size_t count_ = 0;
};

bool isOnObject(const Point2& position, const std::vector<TrueState>& objects,
                const MatchOptions& options) {
  TrackState at_position;
  at_position.box.center = Pose2(position, 0.0);
  return std::any_of(objects.begin(), objects.end(), [&](const TrueState& object) {
    return matchDistance(object, at_position, options) <= options.gate;
  });
}

}  // namespace

std::optional<double> FalseDetections::perFrame() const {
  if (frames == 0) {
    return std::nullopt;
  }
  return static_cast<double>(detections) / static_cast<double>(frames);
}

FalseDetections countFalseDetections(const std::vector<RecordedDetections>& recorded,
                                     const TrueScene& scene, const ScoreOptions& options) {
  const MatchOptions& matching = options.metrics.matching;
  FalseDetections result;
  Episodes episodes(matching.gate, options.detection_gap);
  for (const RecordedDetections& detections : recorded) {
    const auto view = scene.at(detections.stamp);
    if (!view) {
      continue;
    }
    ++result.frames;
    episodes.closeOld(detections.stamp);
    for (const Point2& seen : detections.moving) {
      const Point2 position = view->base_in_map * seen;
      if (scene.isInRegion(view->base_in_map, position) &&
          !isOnObject(position, view->objects, matching)) {
        ++result.detections;
        episodes.add(detections.stamp, position);
      }
    }
  }
  result.episodes = episodes.count();
  return result;
}

}  // namespace datmo::evaluation
