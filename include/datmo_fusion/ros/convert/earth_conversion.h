// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <datmo_fusion/EarthFrame.h>
#include <datmo_fusion/StationTracks.h>

#include <sensor_msgs/NavSatFix.h>

#include "datmo_fusion/fusion/earth/local_plane.h"
#include "datmo_fusion/fusion/earth/station_tracks.h"

namespace datmo {

// As in messages.h, which all stages include; these are of two alone.
using EarthFrameMessage = datmo_fusion::EarthFrame;
using EarthFrameMessagePtr = datmo_fusion::EarthFramePtr;
using StationTracksMessage = datmo_fusion::StationTracks;
using StationTracksMessagePtr = datmo_fusion::StationTracksPtr;

/// Where the map lies on the earth, and how well that is known.
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

/// Of east and north, m^2; where the receiver says nothing of it, that of `sigma` (m) on each axis.
Eigen::Matrix2d covarianceOf(const sensor_msgs::NavSatFix& message, double sigma);

StationTracksMessage toMessage(const StationTrackList& list, const LocalPlane& plane);

/// Our own track, that with id 0, in the plane that touches the earth there.
struct OwnTrack {
  LocalPlane plane;
  StationTrack track;
};

/// None if it is not in the list, or not on the earth.
std::optional<OwnTrack> ownTrack(const StationTracksMessage& message);

/// Tracks that are not on the earth get a position of NaN, so that they are counted.
StationTrackList fromMessage(const StationTracksMessage& message, const LocalPlane& plane);

}  // namespace datmo
