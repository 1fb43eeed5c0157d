// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_fuser.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <tuple>
#include <utility>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/fusion/track/track_extents.h"
#include "datmo_fusion/tracking/track_check.h"

namespace datmo {

namespace {

/// Tracks of different sources are duplicates if the box of one, scaled by this factor, contains
/// the center of the other.
constexpr double kDuplicateGateScale = 1.0;

/// Keeps the tracks most likely to exist, by rising id.
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

/// Orders tracks independently of the order of their sources.
bool isSurer(const Track& a, const Track& b) {
  const auto rank = [](const Track& track) {
    return std::make_tuple(track.covariance.topLeftCorner<2, 2>().determinant(), track.state.x(),
                           track.state.y());
  };
  return rank(a) < rank(b);
}

/// Whether any two of them contradict each other.
bool contradictEachOther(const std::vector<Track>& tracks, const TrackComparisonOptions& options) {
  for (auto a = tracks.begin(); a != tracks.end(); ++a) {
    if (std::any_of(a + 1, tracks.end(), [&](const Track& b) {
          return compare(*a, b, options).squared_distance > options.gate;
        })) {
      return true;
    }
  }
  return false;
}

/// Sensor positions of each list.
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
          weightedClass(track, options_.sources.at(source.source), withoutSpeed);
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

ClassProbabilities TrackFuser::weightedClass(const Track& track, const TrackSourceOptions& source,
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
    tracks.push_back(fusedTrack(group, present, sensors));
    counts.fused += group.size() > 1 ? 1 : 0;
  }
  return tracks;
}

Track TrackFuser::fusedTrack(TrackGroup group, const std::vector<PresentTracks>& present,
                             const std::vector<std::optional<Point2>>& sensors) {
  const auto trackAt = [&](const TrackPosition& position) -> const Track& {
    return present[position.list].tracks[position.track];
  };
  std::sort(group.begin(), group.end(), [&](const TrackPosition& a, const TrackPosition& b) {
    return isSurer(trackAt(a), trackAt(b));
  });
  if (group.size() == 1) {
    return trackAt(group.front());
  }
  const TrackComparisonOptions& comparison = options_.association.comparison;
  std::vector<Track> tracks;
  double age = 0.0;
  for (const TrackPosition& position : group) {
    tracks.push_back(trackAt(position));
    age = std::max(age, tracks.back().age);
  }
  const bool contradict = contradictEachOther(tracks, comparison);
  for (Track& track : tracks) {
    track.covariance.diagonal().head<2>().array() += square(comparison.body_std);
  }
  for (std::size_t i = 0; i < group.size(); ++i) {
    for (std::size_t j = i + 1; j < group.size(); ++j) {
      reconcileExtents(tracks[i], sensors[group[i].list], tracks[j], sensors[group[j].list]);
    }
  }
  Track whole = combined(
      tracks, contradict,
      [&](std::size_t a, std::size_t b) {
        return correlations_.between(trackAt(group[a]), trackAt(group[b]), options_.prediction,
                                     options_.combination);
      },
      options_.combination);
  whole.age = age;
  return whole;
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
