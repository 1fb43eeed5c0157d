// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_fuser.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "datmo_fusion/fusion/object/fused_existence.h"
#include "datmo_fusion/fusion/track/track_extents.h"
#include "datmo_fusion/tracking/track_check.h"

namespace datmo {

namespace {

/// A source can see a position where each of its measurements would have detected the object at
/// least so probably, lately: a quarter is several times a second.
constexpr double kCanSee = 0.25;

/// Time constant of the probability that a source detects: who has just come into view is not
/// missed at once, s.
constexpr double kLookingTime = 1.0;

/// Tracks of different sources are duplicates where the box of one, so many times as large, holds
/// the center of the other.
constexpr double kDuplicateGateScale = 1.0;

/// A source has whatever another one has, of the same sensor.
constexpr double kSurelyAgrees = 1.0;

/// What is likelier not there is of no list.
constexpr double kEven = 0.5;

double positionStd(const Track& track) {
  return std::sqrt(0.5 * track.covariance.topLeftCorner<2, 2>().trace());
}

/// From the nearest of the sensors that looked, m; none if none did.
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

/// What a source's track says of the class, with or without what its speed does.
ClassProbabilities saidOf(const Track& track, const TrackSourceOptions& source,
                          decltype(withSpeed)* weigh, const ClassBySpeedOptions& options) {
  return source.class_by_speed && track.moving
             ? weigh(track.class_probabilities, speedOf({track.state, track.covariance}), options)
             : track.class_probabilities;
}

/// The likeliest ones, by rising id.
void keepLikeliest(std::vector<Track>& tracks, std::size_t max) {
  if (tracks.size() <= max) {
    return;
  }
  std::stable_sort(tracks.begin(), tracks.end(), [](const Track& a, const Track& b) {
    return a.existence_probability > b.existence_probability;
  });
  tracks.resize(max);
  std::sort(tracks.begin(), tracks.end(),
            [](const Track& a, const Track& b) { return a.id < b.id; });
}

/// Where the tracks of each list are seen from.
std::vector<std::optional<Point2>> sensorsOf(const std::vector<SourceTracks>& sources) {
  std::vector<std::optional<Point2>> sensors(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (!sources[i].list->views.empty()) {
      sensors[i] = sources[i].list->views.front().sensor.position();
    }
  }
  return sensors;
}

}  // namespace

TrackFuser::TrackFuser(const Checked<TrackFuserOptions>& options)
    : options_(*options),
      association_(options->association),
      targets_(options->sources.size()),
      newest_(options->sources.size()) {
  for (const auto& [name, source] : options->sources) {
    numbers_[name] = names_.size();
    names_.push_back(name);
  }
}

TrackFusionResult TrackFuser::fuse(Stamp stamp, const std::vector<SourceTracks>& sources) {
  const double seconds = stamp_ ? std::max(0.0, secondsBetween(*stamp_, stamp)) : 0.0;
  stamp_ = stamp;
  TrackFusionResult result;
  result.list.stamp = stamp;
  const std::vector<PresentTracks> present = ingest(stamp, sources, result.counts);
  const std::vector<TrackGroup> groups = association_.associate(stamp, present);
  correlations_.step(seconds);
  targets_.follow(stamp, seconds, fused(groups, present, sensorsOf(sources), result.counts),
                  options_);
  look(sources, seconds);
  judgeAll(stamp, present);
  targets_.publish(kDuplicateGateScale);
  publish(result);
  for (const SourceTracks& source : sources) {
    result.list.views.insert(result.list.views.end(), source.list->views.begin(),
                             source.list->views.end());
  }
  return result;
}

void TrackFuser::setOptions(const Checked<TrackFuserOptions>& options) { options_ = *options; }

void TrackFuser::reset() {
  association_.reset();
  correlations_.clear();
  targets_.clear();
  paths_.clear();
  stamp_.reset();
  newest_.assign(newest_.size(), std::nullopt);
}

std::vector<PresentTracks> TrackFuser::ingest(Stamp stamp, const std::vector<SourceTracks>& sources,
                                              TrackFusionCounts& counts) {
  std::vector<PresentTracks> present;
  for (const SourceTracks& source : sources) {
    PresentTracks own;
    own.source = numbers_.at(source.source);
    own.fresh = newest_[own.source] != source.list->stamp;
    newest_[own.source] = source.list->stamp;
    std::copy_if(source.list->tracks.begin(), source.list->tracks.end(),
                 std::back_inserter(own.tracks), [](const Track& one) { return isValid(one); });
    counts.rejected += source.list->tracks.size() - own.tracks.size();
    const std::size_t valid = own.tracks.size();
    keepLikeliest(own.tracks, static_cast<std::size_t>(options_.max_tracks));
    counts.refused += valid - own.tracks.size();
    for (Track& track : own.tracks) {
      track.class_probabilities =
          saidOf(track, options_.sources.at(source.source), withoutSpeed, options_.class_by_speed);
      track = predicted(std::move(track), secondsBetween(source.list->stamp, stamp),
                        options_.prediction);
      track.sources = {{source.source, track.id}};
      if (track.sensors.empty()) {
        track.sensors = {source.source};
      }
    }
    present.push_back(std::move(own));
  }
  return present;
}

std::vector<Track> TrackFuser::fused(const std::vector<TrackGroup>& groups,
                                     const std::vector<PresentTracks>& present,
                                     const std::vector<std::optional<Point2>>& sensors,
                                     TrackFusionCounts& counts) {
  std::vector<Track> tracks;
  for (const TrackGroup& group : groups) {
    std::optional<Track> whole;
    for (std::size_t i = 0; i < group.size(); ++i) {
      Track track = present[group[i].list].tracks[group[i].track];
      if (!whole) {
        whole = std::move(track);
        continue;
      }
      reconcileExtents(*whole, sensors[group[0].list], track, sensors[group[i].list]);
      const double age = std::max(whole->age, track.age);
      whole = combined(*std::move(whole), track, crossCovariance(group, i, present),
                       options_.combination);
      whole->age = age;
    }
    counts.fused += group.size() > 1 ? 1 : 0;
    tracks.push_back(std::move(*whole));
  }
  return tracks;
}

CrossCovariance TrackFuser::crossCovariance(const TrackGroup& group, std::size_t index,
                                            const std::vector<PresentTracks>& present) {
  CrossCovariance sum = CrossCovariance::Zero();
  if (options_.combination.method != TrackCombinationMethod::kBarShalomCampo) {
    return sum;
  }
  const auto trackAt = [&](std::size_t i) -> const Track& {
    return present[group[i].list].tracks[group[i].track];
  };
  for (std::size_t i = 0; i < index; ++i) {
    sum += correlations_.between(trackAt(i), trackAt(index), options_.prediction,
                                 options_.combination);
  }
  return sum / static_cast<double>(index);
}

void TrackFuser::look(const std::vector<SourceTracks>& sources, double seconds) {
  const double share = kLookingTime > 0.0 ? -std::expm1(-seconds / kLookingTime) : 1.0;
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
  // Two sources that have it from one sensor count once.
  const bool by_two = target.track.sources.size() > 1 && target.track.sensors.size() > 1;
  std::vector<ExistenceReport> reports;
  bool seen_by_all = true;
  for (std::size_t source = 0; source < names_.size(); ++source) {
    const TrackSourceOptions& own = options_.sources.at(names_[source]);
    const Track* const track = trackOf(target, source, present);
    const double looked = target.looked[source].value_or(0.0);
    // Who has a track far away has one as much against chance as close by: both get rarer.
    const double range = track != nullptr ? 0.0 : target.ranges[source].value_or(0.0);
    reports.push_back(
        {track != nullptr,
         track != nullptr
             ? std::min(track->existence_probability,
                        own.true_share.of(saidOf(*track, own, withSpeed, options_.class_by_speed)))
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
      // Who has come out stays: a source into whose view it comes needs time to find it.
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

void TrackFuser::publish(TrackFusionResult& result) {
  for (const FusedTarget& target : targets_.all()) {
    if (target.published) {
      result.list.tracks.push_back(target.track);
      result.list.tracks.back().id = target.id;
    }
  }
  paths_.extend(result.list, options_.history_time);
  result.counts.published = result.list.tracks.size();
}

}  // namespace datmo
