// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

#include "class_shapes.h"
#include "marker_parts.h"

#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/road_conversion.h"
#include "datmo_fusion/ros/display/marker_colors.h"
#include "datmo_fusion/ros/display/markers.h"

namespace datmo {

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

/// Opacity of a border with low probability; a certain one has 1.
constexpr float kUnsure = 0.2F;

/// Brightness of a side street's borders; those of the vehicle's own road have 1.
constexpr float kDim = 0.6F;

/// Line widths of a certain border, one with low probability, and of the lines beside it.
constexpr double kSureWidth = 3.0;
constexpr double kMinWidth = 1.0;
constexpr double kBandWidth = 0.4;

/// Standard deviations between a border and the lines beside it: 95 % of its position.
constexpr double kBandSigmas = 2.0;

/// Text height relative to that of a track.
constexpr double kSmallText = 0.5;

std_msgs::ColorRGBA colorOf(const RoadBorder& border) {
  const float opacity = kUnsure + (1.0F - kUnsure) * static_cast<float>(border.probability);
  const float light = border.side_street ? kDim : 1.0F;
  return colorOfBorder(border.side, light, opacity);
}

Marker lineOf(const std_msgs::Header& header, const RoadBorder& border,
              const MarkersOptions& options) {
  Marker marker = makeMarker(header, "road borders", Marker::LINE_STRIP);
  marker.scale.x = options.line_width * (kMinWidth + (kSureWidth - kMinWidth) * border.probability);
  for (const BorderPoint& point : border.points) {
    marker.points.push_back(pointAt(point.position));
  }
  return marker;
}

/// m, vector from the border to the left line beside it.
Point2 halfBandAt(const std::vector<BorderPoint>& points, std::size_t i) {
  const Point2& before = points[i == 0 ? 0 : i - 1].position;
  const Point2& after = points[std::min(i + 1, points.size() - 1)].position;
  const Point2 along = (after - before).normalized();
  return kBandSigmas * points[i].sigma * perpendicular(along);
}

/// Both lines beside a border, as a list of pieces.
Marker bandOf(const std_msgs::Header& header, const RoadBorder& border,
              const MarkersOptions& options) {
  Marker marker = makeMarker(header, "road border sigmas", Marker::LINE_LIST);
  marker.scale.x = kBandWidth * options.line_width;
  for (std::size_t i = 0; i + 1 < border.points.size(); ++i) {
    const Point2 from = halfBandAt(border.points, i);
    const Point2 to = halfBandAt(border.points, i + 1);
    for (const double side : {1.0, -1.0}) {
      marker.points.push_back(pointAt(border.points[i].position + side * from));
      marker.points.push_back(pointAt(border.points[i + 1].position + side * to));
    }
  }
  return marker;
}

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// "on border 0.3 m".
std::string textOf(const DroppedObjectMessage& dropped) {
  const bool on = dropped.reason == DroppedObjectMessage::ON_BORDER;
  return std::string(on ? "on" : "beyond") + " border" + formatted(" %.1f m", dropped.beyond);
}

Marker labelOf(const std_msgs::Header& header, const DroppedObjectMessage& dropped,
               const MarkersOptions& options) {
  Marker marker = makeMarker(header, "dropped labels", Marker::TEXT_VIEW_FACING);
  marker.pose.position = dropped.object.pose.position;
  marker.pose.position.z = options.default_height;
  marker.scale.z = kSmallText * options.text_height;
  marker.text = textOf(dropped);
  return marker;
}

}  // namespace

MarkerArray markersOf(const RoadBorders& message, const MarkersOptions& options) {
  const RoadModel road = fromMessage(message);
  MarkerArray markers;
  int id = 0;
  for (const RoadBorder& border : road.borders) {
    for (Marker marker :
         {lineOf(message.header, border, options), bandOf(message.header, border, options)}) {
      marker.id = id;
      marker.color = colorOf(border);
      markers.markers.push_back(marker);
    }
    ++id;
  }
  return markers;
}

void addIntersection(const RoadBorders& road, const LabeledScanMessage& scan,
                     const MarkersOptions& options, MarkerArray& markers) {
  if (road.at_intersection == 0) {
    return;
  }
  Marker marker = makeMarker(road.header, "intersection", Marker::TEXT_VIEW_FACING);
  marker.header.frame_id = scan.map_frame;
  marker.pose = toMessage(fromMessage(scan.pose.pose));
  marker.pose.position.z = options.default_height + options.text_height;
  marker.scale.z = options.text_height;
  marker.color = color(1.0F, 1.0F, 1.0F);
  marker.text = formatted("intersection %.2f", static_cast<double>(road.intersection_probability));
  markers.markers.push_back(marker);
}

MarkerArray markersOf(const DroppedObjects& dropped, const MarkersOptions& options) {
  MarkerArray markers;
  int id = 0;
  for (const DroppedObjectMessage& one : dropped.objects) {
    const ObjectMessage& object = one.object;
    for (Marker marker :
         {outlineOf(dropped.header, "dropped objects", object.pose, object.size, options),
          labelOf(dropped.header, one, options)}) {
      marker.id = id;
      marker.color = color(0.5F, 0.5F, 0.5F);
      markers.markers.push_back(marker);
    }
    ++id;
  }
  return markers;
}

}  // namespace datmo
