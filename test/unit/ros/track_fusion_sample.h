// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "fusion_stage_sample.h"

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/track_fusion_stage.h"

namespace datmo {

inline constexpr double kTrackSpeed = 10.0;  // m/s, along x

/// Returns the position of the car of these tests at a time (s), m.
inline double carAt(double seconds) { return kTrackSpeed * (seconds - 100.0); }

/// A car that drives along x, as a tracker of this sensor reports it; `left`: m.
inline Track carTrack(const std::string& sensor, std::uint32_t id, double seconds,
                      double left = 0.0) {
  Track track;
  track.id = id;
  track.state << carAt(seconds), left, kTrackSpeed, 0.0, 0.0, 0.0;
  track.covariance.diagonal() << 0.04, 0.04, 0.25, 0.25, 0.25, 0.25;
  track.mode_probabilities = {0.96, 0.01, 0.01, 0.01, 0.01};
  track.box = {{carAt(seconds), left, 0.0}, 4.0, 1.8};
  track.heading_variance = 0.01;
  track.moving = true;
  track.class_probabilities = {0.025, 0.025, 0.025, 0.9, 0.025};
  track.existence_probability = 0.99;
  track.age = 2.0;
  track.hits = 20;
  track.sensors = {sensor};
  for (int i = 10; i >= 0; --i) {
    const double then = seconds - 0.1 * i;
    track.history.push_back({Stamp::fromSeconds(then), Pose2(carAt(then), left, 0.0)});
  }
  return track;
}

/// A sensor's list in transit.
struct Sent {
  std::string source;
  double stamp = 0.0;  ///< s
};

/// Lists in the order of arrival, by arrival time (s).
using Arrivals = std::multimap<double, Sent>;

/// Returns a sensor's lists from one time to before another (s), which arrive this much later.
inline Arrivals listsOf(const std::string& source, double from, double to, double period,
                        double delay = 0.0) {
  Arrivals lists;
  for (int i = 0; from + period * i < to - 1e-6; ++i) {
    const double stamp = from + period * i;
    lists.emplace(stamp + delay, Sent{source, stamp});
  }
  return lists;
}

class TrackFusionStageTest : public FusionStageTest<TrackFusionStage> {
 protected:
  static constexpr char kLists[] = "track list";
  static constexpr char kFrame[] = "map";
  static constexpr std::uint32_t kLidarsId = 11;
  static constexpr std::uint32_t kStereosId = 22;

  TrackFusionStageTest() : FusionStageTest("track_fusion") {}

  static std::uint32_t idOf(const std::string& source) {
    return source == "lidar" ? kLidarsId : kStereosId;
  }

  static TrackArray list(double seconds, const std::vector<Track>& tracks) {
    return toMessage(TrackList{Stamp::fromSeconds(seconds), tracks, {}}, "map");
  }

  /// Returns the car as a source tracks it.
  static TrackArray carOf(const std::string& source, double seconds) {
    return list(seconds, {carTrack(source, idOf(source), seconds)});
  }

  void handle(const std::string& source, double seconds) { handle(source, carOf(source, seconds)); }
  void handle(const std::string& source, const TrackArray& tracks) {
    handle(source, tracks, toStamp(tracks.header.stamp));
  }
  void handle(const std::string& source, const TrackArray& tracks, Stamp now) {
    stage_.handleTracks(source, tracks, now);
  }

  TrackArrayPtr bothAt(double seconds) {
    handle("lidar", seconds);
    handle("stereo", seconds);
    return nextAt(seconds);
  }

  /// Returns all fused lists that result from these, by the clock of their arrival.
  std::vector<TrackArrayPtr> play(Arrivals lists, const Arrivals& others = {}) {
    lists.insert(others.begin(), others.end());
    std::vector<TrackArrayPtr> fused;
    for (const auto& [at, sent] : lists) {
      collect(at, fused);
      stage_.handleTracks(sent.source, carOf(sent.source, sent.stamp), Stamp::fromSeconds(at));
      collect(at, fused);
    }
    return fused;
  }

 private:
  void collect(double at, std::vector<TrackArrayPtr>& fused) {
    while (const TrackArrayPtr one = nextAt(at)) {
      fused.push_back(one);
    }
  }
};

/// Returns the sources of the only track of a list, by name, and their ids; none if it has none or
/// several.
inline std::map<std::string, std::uint32_t> membersOf(const TrackArray& list) {
  std::map<std::string, std::uint32_t> members;
  if (list.tracks.size() == 1) {
    for (const SourceTrackMessage& source : list.tracks[0].sources) {
      members[source.source] = source.id;
    }
  }
  return members;
}

/// Returns the ids of all tracks of these lists.
inline std::set<std::uint32_t> idsOf(const std::vector<TrackArrayPtr>& lists) {
  std::set<std::uint32_t> ids;
  for (const TrackArrayPtr& list : lists) {
    for (const TrackMessage& track : list->tracks) {
      ids.insert(track.id);
    }
  }
  return ids;
}

}  // namespace datmo
