// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/stereo_view.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "datmo_fusion/common/wide.h"

namespace datmo {

namespace {

/// Minimum horizontal part of the optical axis, 0 to 1: if steeper, the camera has no heading.
constexpr double kMinLevel = 0.1;

/// m; range of depths at which the noise is checked.
constexpr double kNearDepth = 0.1;
constexpr double kFarDepth = 100.0;

bool isPositive(const DepthNoise& noise) {
  return noise.sigma(kNearDepth) > 0.0 && noise.sigma(kFarDepth) > 0.0;
}

void checkCamera(const StereoCamera& camera) {
  const bool measures = camera.focal_length > 0.0 && camera.baseline >= 0.0 &&
                        camera.noise.disparity_at_meter > 0.0 && isPositive(camera.noise);
  // Written so that NaN is rejected as well.
  if (!measures || !(camera.right_tangent > camera.left_tangent)) {
    throw std::invalid_argument(
        "stereo camera: expected a focal length above 0, a baseline of 0 or more, a depth noise "
        "above 0, and a right border of the image to the right of the left one");
  }
}

/// bytes
constexpr std::size_t kCacheLine = 64;

/// Begins to read the points that are viewed next: a cloud is larger than a cache, and its page
/// borders stop the processor from reading ahead.
void fetch(const PointsView& points, std::size_t begin) {
  const std::size_t end = std::min(begin + ViewedPoints::kMax, points.count) * points.step;
  for (std::size_t at = begin * points.step; at < end; at += kCacheLine) {
    __builtin_prefetch(points.data + at);
  }
}

}  // namespace

StereoView::StereoView(const StereoCloud& cloud, const RoadPlane& road)
    : position_(cloud.camera_in_base.translation().head<2>()) {
  checkCamera(cloud.camera);
  const Eigen::Matrix3d rotation = cloud.camera_in_base.linear();
  const Point2 axis = rotation.col(2).head<2>();
  if (!(axis.norm() > kMinLevel)) {
    throw std::invalid_argument(
        "stereo camera: expected to look along the ground, not at it, with its points in the "
        "optical frame (REP 103: z ahead); if they are in another frame, name it in frames/camera");
  }
  const double height = road.heightOf(cloud.camera_in_base.translation());
  if (!(height > 0.0)) {
    throw std::invalid_argument("stereo camera: expected above the road");
  }
  heading_ = axis.normalized();
  Eigen::Matrix3d to_view;
  to_view.row(0) << heading_.x(), heading_.y(), 0.0;
  to_view.row(1) << heading_.y(), -heading_.x(), 0.0;
  to_view.row(2) << -road.slope_x, -road.slope_y, 1.0;
  from_optical_ = (to_view * rotation).cast<float>();
  camera_height_ = static_cast<float>(height);
}

DATMO_FUSION_WIDE
void StereoView::view(const PointsView& points, std::size_t begin, std::size_t count,
                      ViewedPoints& viewed) const {
  std::array<float, ViewedPoints::kMax> x;
  std::array<float, ViewedPoints::kMax> y;
  std::array<float, ViewedPoints::kMax> z;
  fetch(points, begin + count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f point = points.stored(begin + i);
    x[i] = point.x();
    y[i] = point.y();
    z[i] = point.z();
  }
  if (points.inverse_shift != 0.0F) {
    for (std::size_t i = 0; i < count; ++i) {
      const float shrinkage = points.shrinkage(z[i]);
      x[i] /= shrinkage;
      y[i] /= shrinkage;
      z[i] /= shrinkage;
    }
  }
  const Eigen::Matrix3f& m = from_optical_;
  const float height = camera_height_;
  // In the same order as Eigen.
  for (std::size_t i = 0; i < count; ++i) {
    viewed.forward[i] = m(0, 0) * x[i] + (m(0, 1) * y[i] + m(0, 2) * z[i]);
    viewed.right[i] = m(1, 0) * x[i] + (m(1, 1) * y[i] + m(1, 2) * z[i]);
    viewed.height[i] = m(2, 0) * x[i] + (m(2, 1) * y[i] + m(2, 2) * z[i]) + height;
    viewed.inverse[i] = 1.0F / viewed.forward[i];
  }
}

}  // namespace datmo
