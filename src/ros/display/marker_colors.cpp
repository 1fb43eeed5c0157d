// SPDX-License-Identifier: BSD-3-Clause

#include "datmo_fusion/ros/display/marker_colors.h"

#include <algorithm>
#include <cmath>

#include "marker_parts.h"

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/convert/risk_conversion.h"

namespace datmo {

namespace {

/// Share of white in the color of a stationary object.
constexpr float kPaleness = 0.5F;

std_msgs::ColorRGBA fullColorOf(ObjectClass object_class) {
  switch (object_class) {
    case ObjectClass::kVehicle:
      return color(0.05F, 0.4F, 0.95F);
    case ObjectClass::kPedestrian:
      return color(0.9F, 0.05F, 0.55F);
    case ObjectClass::kCyclist:
      return color(0.05F, 0.65F, 0.15F);
    case ObjectClass::kPole:
      return color(0.5F, 0.35F, 0.15F);
    case ObjectClass::kUnknown:
      break;
  }
  return color(0.5F, 0.25F, 0.8F);
}

}  // namespace

std_msgs::ColorRGBA colorOfClass(ObjectClass object_class, bool moving, float opacity) {
  const std_msgs::ColorRGBA full = fullColorOf(object_class);
  const auto channel = [moving](float value) {
    return moving ? value : kPaleness + (1.0F - kPaleness) * value;
  };
  return color(channel(full.r), channel(full.g), channel(full.b), opacity);
}

std_msgs::ColorRGBA colorOfPoint(std::uint8_t state) {
  switch (state) {
    case ScanPointMessage::STATIC:
      return color(0.0F, 0.5F, 0.55F);
    case ScanPointMessage::MOVING:
      return color(1.0F, 0.2F, 0.1F);
    default:
      return color(0.6F, 0.6F, 0.6F);
  }
}

std_msgs::ColorRGBA colorOfBorder(RoadSide side, float brightness, float opacity) {
  const auto left = color(brightness, 0.55F * brightness, 0.1F * brightness, opacity);
  const auto right = color(brightness, 0.35F * brightness, 0.8F * brightness, opacity);
  return side == RoadSide::kLeft ? left : right;
}

std_msgs::ColorRGBA colorOfHue(double hue, float opacity) {
  const auto channel = [hue](double middle) {
    const double apart = std::abs(std::remainder(hue - middle, 1.0));  // 0 to 0.5
    return static_cast<float>(std::clamp(2.0 - 6.0 * apart, 0.0, 1.0));
  };
  return color(channel(0.0), channel(1.0 / 3.0), channel(2.0 / 3.0), opacity);
}

std_msgs::ColorRGBA colorOfTime(double seconds, double horizon, float opacity) {
  constexpr double kGreen = 1.0 / 3.0;
  return colorOfHue(kGreen * std::clamp(seconds / horizon, 0.0, 1.0), opacity);
}

std_msgs::ColorRGBA colorOfLevel(std::uint8_t level) {
  switch (level) {
    case RiskArray::LEVEL_NONE:
      return color(0.1F, 0.6F, 0.25F);
    case RiskArray::LEVEL_INFORMATION:
      return color(0.9F, 0.75F, 0.1F);
    case RiskArray::LEVEL_WARNING:
      return color(0.95F, 0.45F, 0.05F);
    default:
      return color(0.85F, 0.05F, 0.1F);
  }
}

std_msgs::ColorRGBA colorOfOwnVehicle() { return color(0.95F, 0.8F, 0.1F); }

}  // namespace datmo
