// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <visualization_msgs/MarkerArray.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/display/markers.h"

namespace datmo {

/// What the color of a track stands for.
enum class TrackColor : std::uint8_t {
  kClass,   ///< colorOfClass
  kId,      ///< stays with the track; neighbors in number differ much
  kSpeed,   ///< from blue (stands) to red (kFastColored and more)
  kSensors  ///< who saw it last: violet lidar, cyan stereo, yellow several, gray others
};

/// m/s, from which a track has the color of the fastest ones.
inline constexpr double kFastColored = 15.0;

/// How tracks are drawn where a person chooses (rviz); without a choice as the markers are.
struct TrackStyle {
  MarkersOptions sizes;
  TrackColor color_by = TrackColor::kClass;
  double min_existence = 0.0;     ///< 0 to 1; tracks less sure to exist are not drawn
  bool fade_by_existence = true;  ///< the less sure, the more transparent
  double prediction_time = 2.0;   ///< s, at least 0
  double min_mode = 0.15;         ///< 0 to 1; modes less likely have no predicted path
};

/// As markersOf(tracks, options) describes, in the style's colors.
visualization_msgs::MarkerArray markersOf(const TrackArray& tracks, const TrackStyle& style);

/// Where each track goes by each of its likely modes ("track predictions"), by the model of the
/// risks (ObjectFutures) without noise: a line on the ground, the less likely the more transparent.
/// None of a track that is not valid.
visualization_msgs::MarkerArray predictionsOf(const TrackArray& tracks, const TrackStyle& style);

}  // namespace datmo
