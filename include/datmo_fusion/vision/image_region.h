// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/vision/box_projection.h"
#include "datmo_fusion/vision/image_detector.h"

namespace datmo {

/// A camera on the vehicle, and the size of its rectified images.
struct MountedCamera {
  PinholeCamera pinhole;
  double width = 0.0;   ///< px, > 0
  double height = 0.0;  ///< px, > 0
  /// Pose of the optical frame (x right, y down, z forward) in the vehicle's, whose z = 0 is the
  /// road.
  Eigen::Isometry3d in_base = Eigen::Isometry3d::Identity();

  /// The whole image, px.
  Eigen::AlignedBox2d image() const {
    return {Eigen::Vector2d::Zero(), Eigen::Vector2d(width, height)};
  }

  /// m, along the optical axis; negative: behind it. `position`: base frame, on the road.
  double depthOf(const Point2& position) const {
    return (in_base.inverse() * Eigen::Vector3d(position.x(), position.y(), 0.0)).z();
  }
};

/// m; clipping depth, closer than any mounted camera sees another road user.
inline constexpr double kNearestDepth = 0.3;

/// Returns the part of the image that a box on the road covers; empty: behind the camera or beside
/// the image. `height`: m, > 0.
Eigen::AlignedBox2d boxInImage(const MountedCamera& camera, const Box2& box, double height);

/// Returns where an object is in the image (thesis 4.2.3, with its uncertainty): its projected box
/// on the road, and the union with the boxes moved by `sigmas` standard deviations of its position
/// along both axes of its covariance. An object without extent has the size `min_size`.
///
/// None if nothing of it is in the image. `object`: valid (isValid), base frame at the exposure;
/// `default_height` (m, > 0): if its height was not measured; `min_size`: m, > 0.
std::optional<ImageRegion> regionOf(const MountedCamera& camera, const Object& object,
                                    double default_height, double min_size, double sigmas);

}  // namespace datmo
