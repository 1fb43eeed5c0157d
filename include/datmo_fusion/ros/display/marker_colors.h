// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <std_msgs/ColorRGBA.h>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/road/road_model.h"

namespace datmo {

// Each color has one meaning, in the markers, the legend and camera images.

/// Blue: vehicle, magenta: pedestrian, green: cyclist, brown: pole, violet: unknown. Pale if
/// stationary.
std_msgs::ColorRGBA colorOfClass(ObjectClass object_class, bool moving, float opacity);

/// Of a point of the scan, by ScanPoint.state.
std_msgs::ColorRGBA colorOfPoint(std::uint8_t state);

/// Orange on the left, pink on the right; `brightness` 0 to 1.
std_msgs::ColorRGBA colorOfBorder(RoadSide side, float brightness, float opacity);

/// A bright color of a hue: 0 red, 1/3 green, 2/3 blue, 1 red again.
std_msgs::ColorRGBA colorOfHue(double hue, float opacity);

/// Color of a time: from red (now) to green (`horizon`, s, more than 0, or later).
std_msgs::ColorRGBA colorOfTime(double seconds, double horizon, float opacity);

/// Of a level of risk (RiskArray.LEVEL_*): green none, yellow information, orange warning, red
/// imminent.
std_msgs::ColorRGBA colorOfLevel(std::uint8_t level);

/// Of the own vehicle.
std_msgs::ColorRGBA colorOfOwnVehicle();

}  // namespace datmo
