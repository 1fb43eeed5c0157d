// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/visibility/box_silhouette.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/common/cross.h"

namespace datmo {

namespace {

/// m; width of the narrowest objects that sensors detect: a leg, a post.
constexpr double kMinWidth = 0.1;

}  // namespace

BoxSilhouette::BoxSilhouette(const Box2& box, const Point2& sensor)
    : half_(0.5 * std::max(box.length, kMinWidth), 0.5 * std::max(box.width, kMinWidth)),
      sensor_(box.center.inverse() * sensor),
      distance_(sensor_.norm()),
      bearing_(std::atan2(-sensor_.y(), -sensor_.x())) {
  const Point2 to_center = -sensor_;
  for (const double x : {-half_.x(), half_.x()}) {
    for (const double y : {-half_.y(), half_.y()}) {
      const Point2 corner = to_center + Point2(x, y);
      const double offset = std::atan2(cross(to_center, corner), to_center.dot(corner));
      right_ = std::min(right_, offset);
      left_ = std::max(left_, offset);
    }
  }
}

LineCrossing BoxSilhouette::crossing(const Point2& direction) const {
  LineCrossing crossing{0.0, std::numeric_limits<double>::infinity()};
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    if (direction[axis] != 0.0) {
      const double one = (-half_[axis] - sensor_[axis]) / direction[axis];
      const double other = (half_[axis] - sensor_[axis]) / direction[axis];
      crossing.entry = std::max(crossing.entry, std::min(one, other));
      crossing.exit = std::min(crossing.exit, std::max(one, other));
    }
  }
  return crossing;
}

}  // namespace datmo
