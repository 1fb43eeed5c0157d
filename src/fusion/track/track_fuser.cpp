// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_fuser.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/fusion/track/track_extents.h"
#include "datmo_fusion/tracking/track_check.h"

namespace datmo {

namespace {

/// Tracks of different sources are duplicates where the box of one, so many times as large, holds
/// the center of the other.
constexpr double kDuplicateGateScale = 1.0;

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
          reportedClass(track, options_.sources.at(source.source), withoutSpeed);
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

ClassProbabilities TrackFuser::reportedClass(const Track& track, const TrackSourceOptions& source,
                                             decltype(withSpeed)* weigh) const {
  return source.class_by_speed && track.moving
             ? weigh(track.class_probabilities, speedOf({track.state, track.covariance}),
                     options_.class_by_speed)
             : track.class_probabilities;
}

std::vector<Track> TrackFuser::fused(const std::vector<TrackGroup>& groups,
                                     const std::vector<PresentTracks>& present,
                                     const std::vector<std::optional<Point2>>& sensors,
                                     TrackFusionCounts& counts) {
  std::vector<Track> tracks;
  for (const TrackGroup& group : groups) {
    if (group.size() > 1) {
      tracks.push_back(joined(group, present, sensors));
      ++counts.fused;
    } else {
      tracks.push_back(present[group[0].list].tracks[group[0].track]);
    }
  }
  return tracks;
}

Track TrackFuser::joined(const TrackGroup& group, const std::vector<PresentTracks>& present,
                         const std::vector<std::optional<Point2>>& sensors) {
  TrackComparisonOptions comparison = options_.association.comparison;
  const double body_variance = square(comparison.body_std);
  comparison.body_std = 0.0;  // it is in the covariances of the members
  const auto member = [&](std::size_t i) {
    Track track = present[group[i].list].tracks[group[i].track];
    track.covariance.diagonal().head<2>().array() += body_variance;
    return track;
  };
  Track whole = member(0);
  for (std::size_t i = 1; i < group.size(); ++i) {
    Track track = member(i);
    const bool contradict = compare(whole, track, comparison).squared_distance > comparison.gate;
    reconcileExtents(whole, sensors[group[0].list], track, sensors[group[i].list]);
    const double age = std::max(whole.age, track.age);
    whole = combined(std::move(whole), track, contradict, crossCovariance(group, i, present),
                     options_.combination);
    whole.age = age;
  }
  return whole;
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
