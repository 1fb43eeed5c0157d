// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/object_check.h"

#include <algorithm>
#include <cmath>

#include "number_checks.h"

namespace datmo {

namespace {

/// s, before or after its list's stamp: no sensor takes as long for one measurement.
constexpr double kMaxDelay = 10.0;

bool areSides(const std::array<double, kBoxSides>& variances) {
  return std::all_of(variances.begin(), variances.end(),
                     [](double variance) { return variance >= 0.0; });
}

}  // namespace

bool isValid(const Object& object) {
  const Pose2& center = object.box.center;
  return isPosition(center.position()) && std::isfinite(center.heading()) &&
         isModerateAmount(object.box.length) && isModerateAmount(object.box.width) &&
         std::all_of(object.points.begin(), object.points.end(), isPosition) &&
         isAmount(object.heading_variance) && areSides(object.side_variance) &&
         std::isfinite(object.log_odds) && std::isfinite(object.motion_log_odds) &&
         isAmount(object.height) && std::abs(object.delay) <= kMaxDelay &&
         isShare(object.moving_fraction) && isShare(object.class_probability) &&
         isCovariance(object.position_covariance);
}

Object transformed(const Pose2& frame_in_parent, const Object& object) {
  Object result = object;
  result.box.center = frame_in_parent * object.box.center;
  const Eigen::Matrix2d rotation = frame_in_parent.rotation();
  const Eigen::Matrix2d turned = rotation * object.position_covariance * rotation.transpose();
  result.position_covariance = 0.5 * (turned + turned.transpose());
  for (Point2& point : result.points) {
    point = frame_in_parent * point;
  }
  return result;
}

}  // namespace datmo
