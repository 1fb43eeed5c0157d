// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <geometry_msgs/Point.h>
#include <std_msgs/ColorRGBA.h>
#include <std_msgs/Header.h>
#include <visualization_msgs/Marker.h>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

inline std_msgs::ColorRGBA color(float red, float green, float blue, float alpha = 1.0F) {
  std_msgs::ColorRGBA result;
  result.r = red;
  result.g = green;
  result.b = blue;
  result.a = alpha;
  return result;
}

/// The color for lines and text, dark enough to be read on a white map.
inline std_msgs::ColorRGBA inkOf(const std_msgs::ColorRGBA& paint) {
  constexpr float kBrightness = 0.45F;
  return color(kBrightness * paint.r, kBrightness * paint.g, kBrightness * paint.b);
}

inline visualization_msgs::Marker makeMarker(const std_msgs::Header& header,
                                             const std::string& name, int type) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.type = type;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  return marker;
}

inline geometry_msgs::Point pointAt(double x, double y, double z = 0.0) {
  geometry_msgs::Point point;
  point.x = x;
  point.y = y;
  point.z = z;
  return point;
}

inline geometry_msgs::Point pointAt(const Point2& position) {
  return pointAt(position.x(), position.y());
}

}  // namespace datmo
