// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "message_samples.h"
#include "track_fusion_sample.h"

#include "datmo_fusion/ros/convert/message_conversion.h"

/// Encounters of a host that drives along x between walls.
namespace datmo::samples {

/// m/s, of scanBetweenWalls.
inline constexpr double kHostSpeed = 5.0;

/// The list of tracks at this many seconds after kStart: a stationary car, with id 7, on the x axis
/// of the map.
inline TrackArray standingCar(double seconds, double x) {
  TrackList list;
  list.stamp = Stamp::fromSeconds(kStart + seconds);
  Track track = carTrack("lidar", 7, kStart + seconds);
  track.state.setZero();
  track.state[0] = x;
  track.covariance = 0.01 * TrackCovariance::Identity();
  track.moving = false;
  track.mode_probabilities = {0.0, 0.0, 0.0, 0.0, 1.0};
  track.box.center = Pose2(x, 0.0, 0.0);
  list.tracks = {track};
  return toMessage(list, "map");
}

}  // namespace datmo::samples
