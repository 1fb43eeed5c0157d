// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

namespace datmo {

/// An undistorted camera, as for rectified images. Its frame: x right, y down, z forward.
struct PinholeCamera {
  double focal_x = 0.0;   ///< px, > 0
  double focal_y = 0.0;   ///< px, > 0
  double center_x = 0.0;  ///< px, principal point
  double center_y = 0.0;  ///< px
};

/// A box that stands on its bottom face.
struct Box3 {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of the center of its bottom face
  Eigen::Vector3d size = Eigen::Vector3d::Zero();          ///< m: along x, y and z of the pose
};

/// A line segment in an image, px.
struct ImageSegment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

/// Projects the edges of a box into the image: four of the bottom, four of the top, four vertical
/// ones. `box_in_camera`: pose in the camera's frame. Parts closer to the camera's plane than
/// `near` (m, > 0), or behind it, are clipped; an edge that is clipped entirely is omitted. Edges
/// may extend beyond the image.
std::vector<ImageSegment> projectBox(const PinholeCamera& camera, const Box3& box_in_camera,
                                     double near);

/// Returns the smallest axis-aligned rectangle that contains all segments, clipped to an image of
/// `width` x `height` px; empty (Eigen::AlignedBox2d::isEmpty) if nothing is in the image.
Eigen::AlignedBox2d boundsInImage(const std::vector<ImageSegment>& segments, double width,
                                  double height);

}  // namespace datmo
