// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <visualization_msgs/MarkerArray.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/display/markers.h"

namespace datmo {

/// Meaning of a track's color.
enum class TrackColor : std::uint8_t {
  kClass,   ///< colorOfClass
  kId,      ///< constant for a track; consecutive ids differ a lot
  kSpeed,   ///< from blue (stationary) to red (kFastColored and more)
  kSensors  ///< sensors that saw it last: violet lidar, cyan stereo, yellow several, gray others
};

/// What a track looks like.
enum class TrackShape : std::uint8_t {
  kBox,  ///< boxes, cylinders and heads by class, as the markers are
  kMesh  ///< meshes of vehicles, pedestrians and cyclists
};

/// m/s, speed at which the color scale saturates.
inline constexpr double kFastColored = 15.0;

/// User settings for drawing tracks (rviz); the defaults match the markers.
struct TrackStyle {
  MarkersOptions sizes;
  TrackShape shape = TrackShape::kBox;
  TrackColor color_by = TrackColor::kClass;
  double min_existence = 0.0;     ///< 0 to 1; less certain tracks are not drawn
  bool fade_by_existence = true;  ///< more transparent the less certain
  double prediction_time = 2.0;   ///< s, at least 0
  double min_mode = 0.15;         ///< 0 to 1; less likely modes have no predicted path
};

/// As markersOf(tracks, options) describes, in the style's colors.
visualization_msgs::MarkerArray markersOf(const TrackArray& tracks, const TrackStyle& style);

/// Predicted paths of each track for each of its likely modes ("track predictions"), by the model
/// used for the risks (ObjectFutures) without noise: a line on the ground, more transparent the
/// less likely. Invalid tracks have none.
visualization_msgs::MarkerArray predictionsOf(const TrackArray& tracks, const TrackStyle& style);

}  // namespace datmo
