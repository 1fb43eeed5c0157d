// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

namespace datmo {

/// A camera without distortion: that of a rectified image. Its frame: x right, y down, z forward.
struct PinholeCamera {
  double focal_x = 0.0;   ///< px, > 0
  double focal_y = 0.0;   ///< px, > 0
  double center_x = 0.0;  ///< px, principal point
  double center_y = 0.0;  ///< px
};

/// A box that stands on its bottom face.
struct Box3 {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of the middle of its bottom face
  Eigen::Vector3d size = Eigen::Vector3d::Zero();          ///< m: along x, y and z of the pose
};

/// A straight line in an image, px.
struct ImageSegment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

/// The edges of a box as the camera sees them: four of the bottom, four of the top, four upright
/// ones. `box_in_camera`: pose in the camera's frame. What is nearer to the camera's plane than
/// `near` (m, > 0), or behind it, is cut off; an edge of which nothing is left is not there. Edges
/// may reach out of the image.
std::vector<ImageSegment> projectBox(const PinholeCamera& camera, const Box3& box_in_camera,
                                     double near);

/// The smallest rectangle along the image's axes that holds all segments, cut to an image of
/// `width` x `height` px; empty (Eigen::AlignedBox2d::isEmpty) if nothing of it is in the image.
Eigen::AlignedBox2d boundsInImage(const std::vector<ImageSegment>& segments, double width,
                                  double height);

}  // namespace datmo
