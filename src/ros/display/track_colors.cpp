// SPDX-License-Identifier: BSD-3-Clause
#include "track_colors.h"

#include <algorithm>
#include <cmath>

#include "class_shapes.h"
#include "marker_parts.h"

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/display/marker_colors.h"

namespace datmo {

namespace {

/// The golden section: its multiples modulo 1 are evenly spread for any number.
constexpr double kGoldenSection = 0.618033988749895;

/// Hue of slow tracks, blue; fast ones are red, 0.
constexpr double kSlowHue = 0.62;

std_msgs::ColorRGBA paintOf(const TrackMessage& track, TrackColor color_by, bool moving,
                            float opacity) {
  switch (color_by) {
    case TrackColor::kClass:
      break;
    case TrackColor::kId: {
      const double turns = kGoldenSection * track.id;
      return colorOfHue(turns - std::floor(turns), opacity);
    }
    case TrackColor::kSpeed: {
      const double speed = std::hypot(track.velocity.x, track.velocity.y);
      const double share = std::clamp(speed / kFastColored, 0.0, 1.0);
      return colorOfHue(kSlowHue * (1.0 - share), opacity);
    }
    case TrackColor::kSensors:
      return colorOfSensors(track.sensors, opacity);
  }
  return colorOfClass(classFromMessage(track.classification), moving, opacity);
}

}  // namespace

std_msgs::ColorRGBA colorOf(const TrackMessage& track, TrackColor color_by, float opacity) {
  return paintOf(track, color_by, track.moving != 0, opacity);
}

std_msgs::ColorRGBA inkOf(const TrackMessage& track, TrackColor color_by) {
  return inkOf(paintOf(track, color_by, true, 1.0F));
}

}  // namespace datmo
