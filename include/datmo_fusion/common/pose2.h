// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "datmo_fusion/common/angle.h"

namespace datmo {

using Point2 = Eigen::Vector2d;

/// A rigid motion in the plane, and thus the pose of one frame in another: x and y in m, heading in
/// rad in (-pi, pi], counterclockwise from the x axis (REP 103).
///
/// Named by role and direction: `base_in_map` takes points of the base frame to the map frame, and
/// `sensor_in_map = base_in_map * sensor_in_base`.
class Pose2 {
 public:
  Pose2() = default;
  Pose2(double x, double y, double heading) : position_(x, y), heading_(normalizeAngle(heading)) {}
  Pose2(const Point2& position, double heading)
      : position_(position), heading_(normalizeAngle(heading)) {}

  double x() const { return position_.x(); }
  double y() const { return position_.y(); }
  double heading() const { return heading_; }
  const Point2& position() const { return position_; }

  /// Returns the vector rotated by the heading, without the translation.
  Point2 rotate(const Point2& vector) const {
    const double c = std::cos(heading_);
    const double s = std::sin(heading_);
    return {c * vector.x() - s * vector.y(), s * vector.x() + c * vector.y()};
  }

  Eigen::Matrix2d rotation() const {
    const double c = std::cos(heading_);
    const double s = std::sin(heading_);
    Eigen::Matrix2d matrix;
    matrix << c, -s, s, c;
    return matrix;
  }

  Pose2 inverse() const {
    const Pose2 turned_back(0.0, 0.0, -heading_);
    return {turned_back.rotate(-position_), -heading_};
  }

  /// Transforms a point of this frame to the parent frame.
  Point2 operator*(const Point2& point) const { return position_ + rotate(point); }

  /// Composes two poses: returns the other pose in the parent frame.
  Pose2 operator*(const Pose2& other) const {
    return {*this * other.position_, heading_ + other.heading_};
  }

 private:
  Point2 position_ = Point2::Zero();
  double heading_ = 0.0;
};

/// A pose and its covariance over x (m), y (m), heading (rad), all along the parent frame's axes.
struct PoseWithCovariance {
  Pose2 pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

}  // namespace datmo
