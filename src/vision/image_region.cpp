// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/image_region.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace datmo {

Eigen::AlignedBox2d boxInImage(const MountedCamera& camera, const Box2& box, double height) {
  Eigen::Isometry3d in_base(Eigen::AngleAxisd(box.center.heading(), Eigen::Vector3d::UnitZ()));
  in_base.translation() = Eigen::Vector3d(box.center.x(), box.center.y(), 0.0);
  const Box3 in_camera{camera.in_base.inverse() * in_base, {box.length, box.width, height}};
  return boundsInImage(projectBox(camera.pinhole, in_camera, kNearestDepth), camera.width,
                       camera.height);
}

std::optional<ImageRegion> regionOf(const MountedCamera& camera, const Object& object,
                                    double default_height, double min_size, double sigmas) {
  Box2 box = object.box;
  box.length = std::max(box.length, min_size);
  box.width = std::max(box.width, min_size);
  const double height = object.height > 0.0 ? object.height : default_height;
  ImageRegion region;
  region.box = boxInImage(camera, box, height);
  if (region.box.isEmpty() || region.box.volume() <= 0.0) {
    return std::nullopt;
  }
  region.search = region.box;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(object.position_covariance);
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const double sigma = std::sqrt(std::max(0.0, axes.eigenvalues()[axis]));
    const Point2 shift = sigmas * sigma * axes.eigenvectors().col(axis);
    for (const double sign : {-1.0, 1.0}) {
      Box2 moved = box;
      moved.center = Pose2(box.center.position() + sign * shift, box.center.heading());
      region.search.extend(boxInImage(camera, moved, height));
    }
  }
  const double depth = std::max(kNearestDepth, camera.depthOf(box.center.position()));
  region.scale = camera.pinhole.focal_y / depth;
  return region;
}

}  // namespace datmo
