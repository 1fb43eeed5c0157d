// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/sensor_model/road_plane.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// A point in the camera's top view: m from the camera along its horizontal heading, and to the
/// right of it.
struct PointInView {
  double forward = 0.0;
  double right = 0.0;

  double tangent() const { return right / forward; }
};

/// A point in the camera's top view, with its height above the road; m.
struct ViewedPoint {
  float forward = 0.0F;
  float right = 0.0F;
  float height = 0.0F;
};

/// Several ViewedPoints as a structure of arrays, for vectorizable loops.
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

/// The leveled view of a camera: whatever its pitch, points are given by their distances ahead and
/// to the right, and their height above the road. In this view a column of a level image is a
/// sector of constant right / forward, and a line of sight stays in its column.
class StereoView {
 public:
  /// Throws std::invalid_argument for a camera without focal length, depth noise or width, or with
  /// a negative baseline, that looks straight up or down, or is not above the road.
  StereoView(const StereoCloud& cloud, const RoadPlane& road);

  /// `optical`: in the camera's optical frame, m. If it is not finite, neither is `forward`.
  ViewedPoint operator()(const Eigen::Vector3f& optical) const {
    const Eigen::Vector3f turned = from_optical_ * optical;
    return {turned[0], turned[1], turned[2] + camera_height_};
  }

  /// Converts `count` points from `begin` on, at most kMax: bit-identical to one by one.
  void view(const PointsView& points, std::size_t begin, std::size_t count,
            ViewedPoints& viewed) const;

  /// Returns a position (base frame, m) in the view.
  PointInView viewedPoint(const Point2& position) const {
    const Point2 offset = position - position_;
    return {offset.dot(heading_), heading_.y() * offset.x() - heading_.x() * offset.y()};
  }

  /// Returns the position of a point of the view in the base frame, m.
  Point2 positionOf(const PointInView& point) const {
    return position_ + point.forward * heading_ + point.right * Point2(heading_.y(), -heading_.x());
  }

  /// Returns the camera's position in the base frame, m.
  const Point2& position() const { return position_; }
  /// Returns the camera's height above the road, m.
  float cameraHeight() const { return camera_height_; }

 private:
  Point2 position_;
  Point2 heading_;
  Eigen::Matrix3f from_optical_;  ///< rows: forward, right, up from the road
  float camera_height_ = 0.0F;
};

}  // namespace datmo
