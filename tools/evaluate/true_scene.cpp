// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/true_scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace datmo::evaluation {

namespace {

std::set<std::uint32_t> idsOfMovers(const std::vector<RecordedObjects>& recorded) {
  std::set<std::uint32_t> ids;
  for (const RecordedObjects& objects : recorded) {
    for (const RecordedObject& object : objects.objects) {
      if (object.moving) {
        ids.insert(object.state.id);
      }
    }
  }
  return ids;
}

/// The objects whose ids are, or are not (`wanted`), among these.
std::vector<RecordedObjects> selected(const std::vector<RecordedObjects>& recorded,
                                      const std::set<std::uint32_t>& ids, bool wanted) {
  std::vector<RecordedObjects> selection;
  for (const RecordedObjects& objects : recorded) {
    selection.push_back({objects.stamp, {}});
    std::copy_if(objects.objects.begin(), objects.objects.end(),
                 std::back_inserter(selection.back().objects), [&](const RecordedObject& object) {
                   return (ids.count(object.state.id) > 0) == wanted;
                 });
  }
  return selection;
}

const RecordedObject* find(const RecordedObjects& objects, std::uint32_t id) {
  const auto found =
      std::find_if(objects.objects.begin(), objects.objects.end(),
                   [id](const RecordedObject& object) { return object.state.id == id; });
  return found == objects.objects.end() ? nullptr : &*found;
}

/// The object `seconds` after (negative: before) it was as recorded.
RecordedObject carried(const RecordedObject& object, double seconds) {
  RecordedObject result = object;
  const Pose2& center = object.state.box.center;
  result.state.box.center =
      Pose2(center.position() + seconds * object.state.velocity, center.heading());
  return result;
}

/// `share`: 0 at `from`, 1 at `to`.
RecordedObject between(const RecordedObject& from, const RecordedObject& to, double share) {
  RecordedObject result = share < 0.5 ? from : to;
  const Pose2& start = from.state.box.center;
  const Pose2& end = to.state.box.center;
  result.state.box.center =
      Pose2(start.position() + share * (end.position() - start.position()),
            start.heading() + share * angleBetween(start.heading(), end.heading()));
  result.state.velocity = from.state.velocity + share * (to.state.velocity - from.state.velocity);
  return result;
}

std::vector<RecordedObject> between(const RecordedObjects& from, const RecordedObjects& to,
                                    Stamp stamp) {
  const double since = secondsBetween(from.stamp, stamp);
  const double share = since / secondsBetween(from.stamp, to.stamp);
  std::vector<RecordedObject> result;
  for (const RecordedObject& object : from.objects) {
    const RecordedObject* later = find(to, object.state.id);
    result.push_back(later != nullptr ? between(object, *later, share) : carried(object, since));
  }
  for (const RecordedObject& object : to.objects) {
    if (find(from, object.state.id) == nullptr) {
      result.push_back(carried(object, -secondsBetween(stamp, to.stamp)));
    }
  }
  return result;
}

/// What is recorded at the stamp, or between its neighbors; none outside, and in a gap.
std::optional<std::vector<RecordedObject>> objectsAt(const std::vector<RecordedObjects>& recorded,
                                                     Stamp stamp, double max_gap) {
  const auto after =
      std::lower_bound(recorded.begin(), recorded.end(), stamp,
                       [](const RecordedObjects& objects, Stamp s) { return objects.stamp < s; });
  if (after != recorded.end() && after->stamp == stamp) {
    return after->objects;
  }
  if (after == recorded.begin() || after == recorded.end() ||
      secondsBetween((after - 1)->stamp, after->stamp) > max_gap) {
    return std::nullopt;
  }
  return between(*(after - 1), *after, stamp);
}

}  // namespace

TrueScene::TrueScene(const RecordedTruth& truth, const ScoreOptions& options)
    : options_(options), trajectory_(truth.poses, options.max_gap) {
  const std::set<std::uint32_t> movers = idsOfMovers(truth.objects);
  movers_ = selected(truth.objects, movers, true);
  standing_ = selected(truth.objects, movers, false);
  std::transform(movers_.begin(), movers_.end(), std::back_inserter(stamps_),
                 [](const RecordedObjects& objects) { return objects.stamp; });
}

std::optional<TrueScene::View> TrueScene::at(Stamp stamp) const {
  const auto objects = objectsAt(movers_, stamp, options_.max_gap);
  const auto base_in_map = trajectory_.at(stamp);
  if (!objects || !base_in_map) {
    return std::nullopt;
  }
  View view{*base_in_map, {}};
  for (const RecordedObject& object : *objects) {
    view.objects.push_back(object.state);
    view.objects.back().duty = dutyOf(object, *base_in_map);
  }
  return view;
}

std::vector<TrueState> TrueScene::standingAt(Stamp stamp) const {
  const auto objects = objectsAt(standing_, stamp, options_.max_gap);
  const auto base_in_map = trajectory_.at(stamp);
  std::vector<TrueState> standing;
  if (objects && base_in_map) {
    for (const RecordedObject& object : *objects) {
      if (isWanted(object, *base_in_map)) {
        standing.push_back(object.state);
      }
    }
  }
  return standing;
}

bool TrueScene::isInRegion(const Pose2& base_in_map, const Point2& point) const {
  const Point2 seen = base_in_map.inverse() * point;
  return seen.norm() <= options_.region.range &&
         std::abs(std::atan2(seen.y(), seen.x())) <= options_.region.half_angle;
}

Duty TrueScene::dutyOf(const RecordedObject& object, const Pose2& base_in_map) const {
  const bool moves = object.moving && object.state.velocity.norm() >= options_.truth.min_speed;
  return moves && isWanted(object, base_in_map) ? Duty::kRequired : Duty::kOptional;
}

bool TrueScene::isWanted(const RecordedObject& object, const Pose2& base_in_map) const {
  return object.lidar_beams >= options_.truth.min_beams && isSeen(object) &&
         isWantedClass(object.state.classification) &&
         isInRegion(base_in_map, object.state.box.center.position());
}

bool TrueScene::isSeen(const RecordedObject& object) const {
  const std::string& sensor = options_.truth.visible_to;
  const auto& sensors = object.visible_to;
  return sensor == "none" || (sensor == "any" && !sensors.empty()) ||
         std::find(sensors.begin(), sensors.end(), sensor) != sensors.end();
}

bool TrueScene::isWantedClass(ObjectClass classification) const {
  const ClassOptions& wanted = options_.truth.classes;
  switch (classification) {
    case ObjectClass::kPedestrian:
      return wanted.pedestrian;
    case ObjectClass::kCyclist:
      return wanted.cyclist;
    case ObjectClass::kVehicle:
      return wanted.vehicle;
    case ObjectClass::kPole:
      return false;
    case ObjectClass::kUnknown:
      break;
  }
  return wanted.unknown;
}

}  // namespace datmo::evaluation
