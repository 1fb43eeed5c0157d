// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <datmo_fusion/EarthFrame.h>
#include <datmo_fusion/StationTracks.h>

#include <sensor_msgs/NavSatFix.h>

#include "datmo_fusion/fusion/earth/local_plane.h"
#include "datmo_fusion/fusion/earth/station_tracks.h"

namespace datmo {

// Not in messages.h, which all stages include: only two of them use this.
using EarthFrameMessage = datmo_fusion::EarthFrame;
using EarthFrameMessagePtr = datmo_fusion::EarthFramePtr;
using StationTracksMessage = datmo_fusion::StationTracks;
using StationTracksMessagePtr = datmo_fusion::StationTracksPtr;

/// Pose of the map on the earth, and its uncertainty.
struct EarthFrame {
  Stamp stamp;
  LocalPlane plane;
  PoseWithCovariance map_in_plane;
};

EarthFrameMessage toMessage(const EarthFrame& frame, const std::string& map_frame);

/// Throws InputError (`bad_earth_frame`).
EarthFrame fromMessage(const EarthFrameMessage& message);

/// Throws InputError (`no_fix`, `bad_position`).
GeodeticPosition positionOf(const sensor_msgs::NavSatFix& message);

/// Returns the covariance of east and north, m^2; if the receiver gives none, `sigma` (m) per axis.
Eigen::Matrix2d covarianceOf(const sensor_msgs::NavSatFix& message, double sigma);

StationTracksMessage toMessage(const StationTrackList& list, const LocalPlane& plane);

/// Our own track, the one with id 0, in the plane tangent to the earth there.
struct OwnTrack {
  LocalPlane plane;
  StationTrack track;
};

/// Returns none if it is not in the list or its position is invalid.
std::optional<OwnTrack> ownTrack(const StationTracksMessage& message);

/// Tracks with an invalid position get NaN, so that they are counted.
StationTrackList fromMessage(const StationTracksMessage& message, const LocalPlane& plane);

}  // namespace datmo
