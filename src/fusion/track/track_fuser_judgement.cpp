// SPDX-License-Identifier: BSD-3-Clause
// Second half of TrackFuser's step: field of view, existence, and publication.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "datmo_fusion/fusion/object/fused_existence.h"
#include "datmo_fusion/fusion/track/track_fuser.h"

namespace datmo {

namespace {

/// A source can see a position if each of its measurements would recently have detected the object
/// with at least this probability: a quarter amounts to several detections per second.
constexpr double kCanSee = 0.25;

/// Time constant of a source's detection probability, s: an object that has just come into view is
/// not expected to have a track at once.
constexpr double kLookingTime = 1.0;

/// Sources with the same sensor have the same tracks.
constexpr double kSurelyAgrees = 1.0;

/// Tracks that probably do not exist are never published.
constexpr double kEven = 0.5;

double positionStd(const Track& track) {
  return std::sqrt(0.5 * track.covariance.topLeftCorner<2, 2>().trace());
}

/// Distance to the nearest of the sensors that looked, m; none if none did.
std::optional<double> rangeFrom(const std::vector<ViewFan>& fans, const Track& track) {
  std::optional<double> nearest;
  for (const ViewFan& fan : fans) {
    const double range = (track.box.center.position() - fan.sensor.position()).norm();
    if (!fan.reach.empty() && (!nearest || range < *nearest)) {
      nearest = range;
    }
  }
  return nearest;
}

}  // namespace

void TrackFuser::look(const std::vector<SourceTracks>& sources, double seconds) {
  const double share = -std::expm1(-seconds / kLookingTime);
  std::vector<std::optional<Visibility>> views(names_.size());
  std::vector<const std::vector<ViewFan>*> fans_of(names_.size());
  for (const SourceTracks& source : sources) {
    const std::vector<ViewFan>& fans = source.list->views;
    if (std::any_of(fans.begin(), fans.end(),
                    [](const ViewFan& fan) { return !fan.reach.empty(); })) {
      views[numbers_.at(source.source)].emplace(fans, options_.visibility);
      fans_of[numbers_.at(source.source)] = &fans;
    }
  }
  for (FusedTarget& target : targets_.all()) {
    for (std::size_t source = 0; source < names_.size(); ++source) {
      double now = 0.0;
      if (views[source] && target.present && !target.member(names_[source])) {
        now = views[source]->detectionProbability(target.track.box, positionStd(target.track));
      }
      std::optional<double>& looked = target.looked[source];
      looked = looked ? *looked + share * (now - *looked) : now;
      target.ranges[source] =
          fans_of[source] != nullptr ? rangeFrom(*fans_of[source], target.track) : std::nullopt;
    }
  }
}

void TrackFuser::judgeAll(Stamp stamp, const std::vector<PresentTracks>& present) {
  ClassMemory::Beliefs beliefs;
  for (const PresentTracks& list : present) {
    for (const Track& track : list.tracks) {
      beliefs[{names_[list.source], track.id}] = track.class_probabilities;
    }
  }
  for (FusedTarget& target : targets_.all()) {
    target.updateClass(beliefs, options_.class_by_speed);
    if (target.present) {
      judge(target, stamp, present);
    }
    target.wanted = target.present && isWanted(target);
  }
}

const Track* TrackFuser::trackOf(const FusedTarget& target, std::size_t source,
                                 const std::vector<PresentTracks>& present) const {
  const std::optional<std::uint32_t> id = target.member(names_[source]);
  const auto own = std::find_if(present.begin(), present.end(),
                                [&](const PresentTracks& list) { return list.source == source; });
  if (!id || own == present.end()) {
    return nullptr;
  }
  const auto found = std::find_if(own->tracks.begin(), own->tracks.end(),
                                  [&](const Track& track) { return track.id == *id; });
  return found == own->tracks.end() ? nullptr : &*found;
}

void TrackFuser::judge(FusedTarget& target, Stamp stamp,
                       const std::vector<PresentTracks>& present) const {
  // Two sources with tracks from the same sensor count once.
  const bool by_two = target.track.sources.size() > 1 && target.track.sensors.size() > 1;
  std::vector<ExistenceReport> reports;
  bool seen_by_all = true;
  for (std::size_t source = 0; source < names_.size(); ++source) {
    const TrackSourceOptions& own = options_.sources.at(names_[source]);
    const Track* const track = trackOf(target, source, present);
    const double looked = target.looked[source].value_or(0.0);
    // A distant track is as much evidence against chance as a close one: true and false tracks both
    // get rarer.
    const double range = track != nullptr ? 0.0 : target.ranges[source].value_or(0.0);
    reports.push_back({track != nullptr,
                       track != nullptr
                           ? std::min(track->existence_probability,
                                      own.true_share.of(weightedClass(*track, own, withSpeed)))
                           : 0.0,
                       looked, own.detection.probability(target.track.class_probabilities, range),
                       by_two ? own.false_agreement_probability : kSurelyAgrees});
    seen_by_all = seen_by_all && (track != nullptr || looked < kCanSee);
  }
  target.track.existence_probability = fusedExistence(reports);
  target.track.age = secondsBetween(target.born, stamp);
  target.confirmed = target.confirmed || (seen_by_all && by_two);
}

bool TrackFuser::isWanted(const FusedTarget& target) const {
  const double existence = target.track.existence_probability;
  if (existence < kEven) {
    return false;
  }
  switch (options_.scheme) {
    case TrackScheme::kByExistence:
      // A published track stays: a source whose view it enters needs time to detect it.
      return target.confirmed || target.published || existence >= options_.published_existence;
    case TrackScheme::kFusedPlusFallback:
      return target.confirmed || (target.track.sources.size() == 1 &&
                                  target.member(options_.beyond) && !isInOthersView(target));
    case TrackScheme::kConfirmedByAll:
      return target.confirmed;
    case TrackScheme::kUnion:
      break;
  }
  return true;
}

bool TrackFuser::isInOthersView(const FusedTarget& target) const {
  const double min = target.published ? std::max(kCanSee, options_.misses) : kCanSee;
  return std::any_of(target.looked.begin(), target.looked.end(),
                     [min](const auto& looked) { return looked.value_or(0.0) >= min; });
}

}  // namespace datmo
