// SPDX-License-Identifier: BSD-3-Clause
#include "class_shapes.h"

#include <algorithm>

#include "marker_parts.h"

#include "datmo_fusion/ros/display/meshes.h"

namespace datmo {

namespace {

using visualization_msgs::Marker;

/// Share of the head in a person's height, and in a cyclist's.
constexpr double kHeadShare = 0.2;

/// m; thickness of thin shapes.
constexpr double kThin = 0.2;

/// Size as drawn: a size of 0 is not known.
geometry_msgs::Vector3 drawnSize(const geometry_msgs::Vector3& size,
                                 const MarkersOptions& options) {
  geometry_msgs::Vector3 whole;
  whole.x = std::max(size.x, options.min_size);
  whole.y = std::max(size.y, options.min_size);
  whole.z = size.z > 0.0 ? size.z : options.default_height;
  return whole;
}

/// Upright, standing on the ground.
Marker standing(const std_msgs::Header& header, const std::string& name, int type,
                const geometry_msgs::Pose& pose, const geometry_msgs::Vector3& size) {
  Marker marker = makeMarker(header, name + " bodies", type);
  marker.pose = pose;
  marker.pose.position.z = 0.5 * size.z;
  marker.scale = size;
  return marker;
}

Marker headOn(const Marker& body, const std::string& name, double diameter) {
  Marker head = makeMarker(body.header, name + " heads", Marker::SPHERE);
  head.pose = body.pose;
  head.pose.position.z = body.scale.z + 0.5 * diameter;
  head.scale.x = diameter;
  head.scale.y = diameter;
  head.scale.z = diameter;
  return head;
}

}  // namespace

ClassShape shapeOf(const std_msgs::Header& header, const std::string& name,
                   ObjectClass object_class, const geometry_msgs::Pose& pose,
                   const geometry_msgs::Vector3& size, const MarkersOptions& options) {
  geometry_msgs::Vector3 whole = drawnSize(size, options);
  const double diameter = kHeadShare * whole.z;
  geometry_msgs::Vector3 below_head = whole;
  below_head.z -= diameter;
  switch (object_class) {
    case ObjectClass::kPedestrian: {
      const Marker body = standing(header, name, Marker::CYLINDER, pose, below_head);
      return {body, headOn(body, name, diameter)};
    }
    case ObjectClass::kCyclist: {
      below_head.y = kThin;
      const Marker body = standing(header, name, Marker::CUBE, pose, below_head);
      return {body, headOn(body, name, diameter)};
    }
    case ObjectClass::kPole:
      whole.x = kThin;
      whole.y = kThin;
      return {standing(header, name, Marker::CYLINDER, pose, whole), std::nullopt};
    case ObjectClass::kVehicle:
    case ObjectClass::kUnknown:
      break;
  }
  return {standing(header, name, Marker::CUBE, pose, whole), std::nullopt};
}

std::optional<Marker> meshOf(const std_msgs::Header& header, const std::string& name,
                             ObjectClass object_class, const geometry_msgs::Pose& pose,
                             const geometry_msgs::Vector3& size, const MarkersOptions& options) {
  const std::string resource = meshResourceOf(object_class);
  if (resource.empty()) {
    return std::nullopt;
  }
  Marker marker = makeMarker(header, name + " bodies", Marker::MESH_RESOURCE);
  marker.mesh_resource = resource;
  marker.pose = pose;
  marker.pose.position.z = 0.0;
  marker.scale = drawnSize(size, options);
  return marker;
}

std_msgs::ColorRGBA colorOfSensors(const std::vector<std::string>& sensors, float opacity) {
  if (sensors.size() > 1) {
    return color(1.0F, 0.9F, 0.1F, opacity);
  }
  const std::string name = sensors.empty() ? "" : sensors.front();
  if (name == "lidar") {
    return color(0.7F, 0.4F, 1.0F, opacity);
  }
  return name == "stereo" ? color(0.1F, 0.9F, 0.9F, opacity) : color(0.6F, 0.6F, 0.6F, opacity);
}

std::string namesOf(const std::vector<std::string>& sensors) {
  std::string names;
  for (const std::string& sensor : sensors) {
    names += (names.empty() ? "" : "+") + sensor;
  }
  return names;
}

Marker outlineOf(const std_msgs::Header& header, const std::string& name,
                 const geometry_msgs::Pose& pose, const geometry_msgs::Vector3& size,
                 const MarkersOptions& options) {
  Marker marker = makeMarker(header, name, Marker::LINE_STRIP);
  marker.pose = pose;
  marker.scale.x = options.line_width;
  const double x = 0.5 * std::max(size.x, options.min_size);
  const double y = 0.5 * std::max(size.y, options.min_size);
  marker.points = {pointAt(x, y), pointAt(-x, y), pointAt(-x, -y), pointAt(x, -y), pointAt(x, y)};
  return marker;
}

}  // namespace datmo
