// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

namespace datmo {

/// A corner of a triangle.
struct DrawnVertex {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< m
  std_msgs::ColorRGBA color;                           ///< lit already
};

/// Letters that face who looks.
struct DrawnLabel {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< m, the middle
  std::string text;
  float height = 1.0F;  ///< m
  std_msgs::ColorRGBA color;
};

/// What a 3D view puts on the screen, in one frame: any number of shapes as two lists of triangles,
/// so that hundreds of tracks are as few batches as one.
struct Drawing {
  std::vector<DrawnVertex> solid;        ///< three each; they hide what is behind
  std::vector<DrawnVertex> translucent;  ///< three each
  std::vector<DrawnLabel> labels;
  std::size_t left_out = 0;  ///< markers with a number that is not finite
};

/// The shapes of markers of one frame as triangles: boxes, cylinders, spheres, arrows of two
/// points, lines (flat ribbons above the ground), lists of triangles, and texts. Markers of other
/// types, and those with a number that is not finite, are left out.
Drawing drawingOf(const visualization_msgs::MarkerArray& markers);

}  // namespace datmo
