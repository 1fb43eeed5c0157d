// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "datmo_fusion/fusion/earth/station_tracks.h"

namespace datmo::station_samples {

inline const Pose2 kMap(40.0, -20.0, 1.1);  // in the plane
inline constexpr double kPeriod = 0.1;      // s

inline PoseWithCovariance mapInPlane() {
  PoseWithCovariance map{kMap, Eigen::Matrix3d::Zero()};
  map.covariance.diagonal() << 0.25, 0.25, 1e-4;
  return map;
}

/// A pedestrian as a pole camera reports it.
inline StationTrack walker(const Point2& position) {
  StationTrack track;
  track.id = 7;
  track.position = position;
  track.velocity = {1.2, 0.5};
  track.covariance = Eigen::Vector4d(0.09, 0.09, 0.04, 0.04).asDiagonal();
  track.length = track.width = 0.5;
  track.class_probabilities[static_cast<std::size_t>(ObjectClass::kPedestrian)] = 1.0;
  return track;
}

inline StationTrackList listAt(int step, const std::vector<StationTrack>& tracks) {
  StationTrackList list;
  list.stamp = Stamp::fromSeconds(50.0 + kPeriod * step);
  list.station = 3;
  list.tracks = tracks;
  return list;
}

inline Point2 pathAt(int step) { return Point2(60.0, -10.0) + kPeriod * step * Point2(1.2, 0.5); }

/// A track at a point with this id.
inline StationTrack numbered(std::uint32_t id, const Point2& position) {
  StationTrack track = walker(position);
  track.id = id;
  return track;
}

}  // namespace datmo::station_samples
