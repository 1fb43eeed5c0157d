// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include "datmo_fusion/ros/display/meshes.h"

namespace datmo {

/// Vertex of a triangle.
struct DrawnVertex {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< m
  std_msgs::ColorRGBA color;                           ///< with lighting applied
};

/// A text that faces the viewer.
struct DrawnLabel {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< m, its center
  std::string text;
  float height = 1.0F;  ///< m
  std_msgs::ColorRGBA color;
};

/// Content of a 3D view in one frame: any number of shapes as three lists of triangles, so that
/// hundreds of tracks need only three batches.
struct Drawing {
  std::vector<DrawnVertex> solid;        ///< three per triangle; opaque
  std::vector<DrawnVertex> translucent;  ///< three per triangle
  std::vector<DrawnVertex> meshes;       ///< three per triangle; translucent, only the front shows
  std::vector<DrawnLabel> labels;
  std::size_t left_out = 0;  ///< markers with a non-finite number
};

/// Converts the markers of one frame to triangles: boxes, cylinders, spheres, arrows given by two
/// points, lines (flat ribbons above the ground), triangle lists, texts, and those of `meshes`.
/// Markers of other types, and those with non-finite numbers, are omitted.
Drawing drawingOf(const visualization_msgs::MarkerArray& markers, const Meshes& meshes = {});

}  // namespace datmo
