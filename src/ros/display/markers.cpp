// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/markers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "class_shapes.h"
#include "marker_parts.h"

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/display/marker_colors.h"

namespace datmo {

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

/// Outlines of ground-truth objects: line width relative to the other lines, and the length of a
/// dash and of the following gap, m.
constexpr double kThinLine = 0.7;
constexpr double kDash = 0.4;

/// Converts the lines of a strip to dashes.
Marker dashed(Marker strip) {
  std::vector<geometry_msgs::Point> dashes;
  for (std::size_t i = 0; i + 1 < strip.points.size(); ++i) {
    const geometry_msgs::Point& from = strip.points[i];
    const geometry_msgs::Point& to = strip.points[i + 1];
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    for (double at = 0.0; at < length; at += 2.0 * kDash) {
      for (const double end : {at, std::min(at + kDash, length)}) {
        const double share = end / length;
        dashes.push_back(
            pointAt(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)));
      }
    }
  }
  strip.type = Marker::LINE_LIST;
  strip.points = std::move(dashes);
  return strip;
}

/// Opacity of outlines of objects not known to move, and of bodies.
constexpr float kPale = 0.4F;
constexpr float kBody = 0.3F;

}  // namespace

void MarkersOptions::visit(OptionVisitor& visitor) {
  const Bounds size{0.01, 10.0};
  visitor.number({"point_size", "m", "edge length of a scan point", Tier::kLive}, point_size, size);
  visitor.number({"line_width", "m", "width of outlines; arrows scale with it", Tier::kLive},
                 line_width, size);
  visitor.number({"text_height", "m", "height of the letters of a track's label", Tier::kLive},
                 text_height, size);
  visitor.number({"min_size", "m", "minimum length and width of a box as drawn"}, min_size, size);
  visitor.number({"default_height", "m", "height of a box whose height is not measured"},
                 default_height, size);
  visitor.number({"arrow_time", "s", "a track's arrow is the distance that it travels in this time",
                  Tier::kLive},
                 arrow_time, {0.0, 10.0});
  visitor.number(
      {"path_time", "s", "a track's path shows its positions over this time", Tier::kLive},
      path_time, {0.0, 600.0});
  visitor.group("vehicle", [&] { vehicle.visit(visitor); });
}

SharedKeys MarkersOptions::sharedKeys() {
  return SharedKeys().group<VehicleBodyOptions>("vehicle/", "vehicle/");
}

MarkerArray markersOf(const LabeledScanMessage& scan, const MarkersOptions& options) {
  std_msgs::Header header = scan.header;
  header.frame_id = scan.map_frame;
  Marker marker = makeMarker(header, "scan", Marker::POINTS);
  marker.pose = scan.pose.pose;
  marker.scale.x = options.point_size;
  marker.scale.y = options.point_size;
  marker.points.reserve(scan.points.size());
  marker.colors.reserve(scan.points.size());
  for (const ScanPointMessage& point : scan.points) {
    marker.points.push_back(pointAt(point.x, point.y));
    marker.colors.push_back(colorOfPoint(point.state));
  }
  MarkerArray markers;
  if (!marker.points.empty()) {  // rviz reports an empty list as an error
    markers.markers.push_back(marker);
  }
  return markers;
}

MarkerArray markersOf(const ObjectArray& objects, const MarkersOptions& options) {
  MarkerArray markers;
  int id = 0;
  const auto add = [&](Marker marker, const std_msgs::ColorRGBA& paint) {
    marker.id = id;
    marker.color = paint;
    markers.markers.push_back(marker);
  };
  for (const ObjectMessage& object : objects.objects) {
    const bool moves = object.dynamic_state == ObjectMessage::STATE_MOVING;
    add(outlineOf(objects.header, "objects", object.pose, object.size, options),
        colorOfSensors(object.sensors, moves ? 1.0F : kPale));
    const ObjectClass object_class = classFromMessage(object.classification);
    if (object_class != ObjectClass::kUnknown) {
      const ClassShape shape =
          shapeOf(objects.header, "object", object_class, object.pose, object.size, options);
      add(shape.body, colorOfSensors(object.sensors, kBody));
      if (shape.head) {
        add(*shape.head, colorOfSensors(object.sensors, kBody));
      }
    }
    ++id;
  }
  return markers;
}

MarkerArray markersOf(const TrueObjectArray& objects, const MarkersOptions& options) {
  MarkerArray markers;
  for (const TrueObject& object : objects.objects) {
    if (object.moving) {
      Marker marker =
          dashed(outlineOf(objects.header, "ground truth", object.pose, object.size, options));
      marker.id = static_cast<int>(object.id);
      marker.scale.x = kThinLine * options.line_width;
      marker.color = color(0.25F, 0.25F, 0.25F);
      markers.markers.push_back(marker);
    }
  }
  return markers;
}

void transformToMap(const LabeledScanMessage& scan, MarkerArray& markers) {
  const Pose2 base_in_map = fromMessage(scan.pose.pose);
  for (Marker& marker : markers.markers) {
    const double z = marker.pose.position.z;
    marker.header.frame_id = scan.map_frame;
    marker.pose = toMessage(base_in_map * fromMessage(marker.pose));
    marker.pose.position.z = z;
  }
}

void StaleMarkers::replace(const std::string& source, MarkerArray& markers) {
  std::set<Key> now;
  for (const Marker& marker : markers.markers) {
    now.emplace(marker.ns, marker.id);
  }
  std::set<Key>& before = drawn_[source];
  for (const Key& key : before) {
    if (now.count(key) == 0) {
      Marker gone;
      gone.ns = key.first;
      gone.id = key.second;
      gone.action = Marker::DELETE;
      markers.markers.push_back(gone);
    }
  }
  before = std::move(now);
}

}  // namespace datmo
