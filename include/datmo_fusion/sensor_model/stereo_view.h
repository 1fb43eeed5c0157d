// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/sensor_model/road_plane.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// A point as the camera sees it from above: m from the camera along its horizontal heading, and to
/// the right of it.
struct PointInView {
  double forward = 0.0;
  double right = 0.0;

  double tangent() const { return right / forward; }
};

/// A point as the camera sees it from above, with its height above the road; m.
struct ViewedPoint {
  float forward = 0.0F;
  float right = 0.0F;
  float height = 0.0F;
};

/// Some ViewedPoint, each number of all of them together, for loops that compilers turn into
/// vectors.
struct ViewedPoints {
  static constexpr std::size_t kMax = 64;
  std::array<float, kMax> forward;
  std::array<float, kMax> right;
  std::array<float, kMax> height;
  std::array<float, kMax> inverse;  ///< 1/m, of `forward`

  ViewedPoint operator[](std::size_t index) const {
    return {forward[index], right[index], height[index]};
  }
};

/// The camera brought level: however it is pitched, points are given by how far ahead and aside
/// they are, and points by their height above the road. In this view a column of a level image is a
/// sector of constant right / forward, and a line of sight stays in its column.
class StereoView {
 public:
  /// Throws std::invalid_argument for a camera that has no focal length, noise of the depth or
  /// width, or a negative baseline, looks straight up or down, or is not above the road.
  StereoView(const StereoCloud& cloud, const RoadPlane& road);

  /// `optical`: in the camera's optical frame, m. Not finite in, not finite `forward` out.
  ViewedPoint operator()(const Eigen::Vector3f& optical) const {
    const Eigen::Vector3f turned = from_optical_ * optical;
    return {turned[0], turned[1], turned[2] + camera_height_};
  }

  /// Of `count` points from `begin` on, kMax at the most: to the bit as one by one.
  void view(const PointsView& points, std::size_t begin, std::size_t count,
            ViewedPoints& viewed) const;

  /// `position`: base frame, m.
  PointInView viewedPoint(const Point2& position) const {
    const Point2 offset = position - position_;
    return {offset.dot(heading_), heading_.y() * offset.x() - heading_.x() * offset.y()};
  }

  /// Base frame, m.
  Point2 positionOf(const PointInView& point) const {
    return position_ + point.forward * heading_ + point.right * Point2(heading_.y(), -heading_.x());
  }

  /// Of the camera, in the base frame, m.
  const Point2& position() const { return position_; }
  /// Above the road, m.
  float cameraHeight() const { return camera_height_; }

 private:
  Point2 position_;
  Point2 heading_;
  Eigen::Matrix3f from_optical_;  ///< rows: forward, right, up from the road
  float camera_height_ = 0.0F;
};

}  // namespace datmo
