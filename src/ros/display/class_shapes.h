// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Vector3.h>
#include <std_msgs/ColorRGBA.h>
#include <std_msgs/Header.h>
#include <visualization_msgs/Marker.h>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/ros/display/markers.h"

namespace datmo {

/// Shape of an object by class, on the ground and in its size (thesis figure 4.13): a box for a
/// vehicle or an unknown class, a thin cylinder for a pole, a cylinder with a head for a pedestrian
/// and a narrow box with a head for a cyclist. The caller sets the colors.
struct ClassShape {
  visualization_msgs::Marker body;
  std::optional<visualization_msgs::Marker> head;
};

/// Returns the shape in the namespaces "<name> bodies" and "<name> heads".
ClassShape shapeOf(const std_msgs::Header& header, const std::string& name,
                   ObjectClass object_class, const geometry_msgs::Pose& pose,
                   const geometry_msgs::Vector3& size, const MarkersOptions& options);

/// Returns the mesh of a class in the namespace "<name> bodies", in the object's size; none if the
/// class has no mesh.
std::optional<visualization_msgs::Marker> meshOf(const std_msgs::Header& header,
                                                 const std::string& name, ObjectClass object_class,
                                                 const geometry_msgs::Pose& pose,
                                                 const geometry_msgs::Vector3& size,
                                                 const MarkersOptions& options);

/// Color of the sensors: violet lidar, cyan stereo (as in thesis figure 3.13), yellow two or more,
/// gray any other one.
std_msgs::ColorRGBA colorOfSensors(const std::vector<std::string>& sensors, float opacity);

/// "lidar+stereo".
std::string namesOf(const std::vector<std::string>& sensors);

/// A rectangle on the ground.
visualization_msgs::Marker outlineOf(const std_msgs::Header& header, const std::string& name,
                                     const geometry_msgs::Pose& pose,
                                     const geometry_msgs::Vector3& size,
                                     const MarkersOptions& options);

}  // namespace datmo
