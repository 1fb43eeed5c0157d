// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fusion_tracks.h"

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/fusion/track/track_fuser.h"

namespace datmo {

/// A time in the tests of TrackFuser, s since they began.
inline Stamp at(double seconds) { return Stamp::fromSeconds(100.0 + seconds); }

/// All around a sensor at the origin, to this range.
inline ViewFan allAround(double range) {
  ViewFan fan;
  fan.first_bearing = -kPi;
  fan.beam_spacing = degrees(1.0);
  fan.sure_range = range;
  fan.range = range;
  fan.reach.assign(360, range);
  return fan;
}

inline SourceTracks received(const std::string& source, double seconds, std::vector<Track> tracks,
                             std::vector<ViewFan> views) {
  auto list = std::make_shared<TrackList>();
  list->stamp = at(seconds);
  list->tracks = std::move(tracks);
  list->views = std::move(views);
  return {source, list};
}

/// The scanner sees to 80 m, the camera to 40 m.
inline SourceTracks lidar(double seconds, std::vector<Track> tracks) {
  return received("lidar", seconds, std::move(tracks), {allAround(80.0)});
}
inline SourceTracks stereo(double seconds, std::vector<Track> tracks) {
  return received("stereo", seconds, std::move(tracks), {allAround(40.0)});
}

/// Drives along y = 0 and is at x at 0 s.
inline Track driving(double x, double seconds, const std::string& source, std::uint32_t id = 1) {
  return carTrack(x + 5.0 * seconds, 0.0, 5.0, 0.0, source, id);
}

inline std::vector<std::uint32_t> idsOf(const TrackFusionResult& result) {
  std::vector<std::uint32_t> ids;
  for (const Track& track : result.list.tracks) {
    ids.push_back(track.id);
  }
  return ids;
}

inline TrackFuserOptions withScheme(TrackScheme scheme) {
  TrackFuserOptions options;
  options.scheme = scheme;
  return options;
}

}  // namespace datmo
