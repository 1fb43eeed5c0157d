// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_msgs/ColorRGBA.h>

#include "datmo_fusion/ros/display/track_style.h"

namespace datmo {

/// Color of a track's body and ellipse.
std_msgs::ColorRGBA colorOf(const TrackMessage& track, TrackColor color_by, float opacity);

/// Color of its lines and text: darker, to be readable on a light map.
std_msgs::ColorRGBA inkOf(const TrackMessage& track, TrackColor color_by);

}  // namespace datmo
