// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "datmo_fusion/common/angle.h"

namespace datmo {

using Point2 = Eigen::Vector2d;

/// A rigid motion of the plane, and so the pose of a frame in another one: x and y in m, heading in
/// rad in (-pi, pi], from the x axis to the left (REP 103).
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

  /// The vector, turned by the heading but not moved.
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

  /// This frame's point in the parent frame.
  Point2 operator*(const Point2& point) const { return position_ + rotate(point); }

  /// This motion after the other one: the other pose, seen from the parent frame.
  Pose2 operator*(const Pose2& other) const {
    return {*this * other.position_, heading_ + other.heading_};
  }

 private:
  Point2 position_ = Point2::Zero();
  double heading_ = 0.0;
};

/// A pose and its covariance over x (m), y (m), heading (rad), all in the parent frame's axes.
struct PoseWithCovariance {
  Pose2 pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

}  // namespace datmo
