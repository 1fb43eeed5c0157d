// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/object_check.h"

#include <algorithm>
#include <cmath>

#include "number_checks.h"

namespace datmo {

namespace {

/// m/s; a sensor that measures more is broken.
constexpr double kMaxObjectSpeed = 100.0;

/// m^2 and (m/s)^2; a position known to no better than a kilometer is not a measurement, and in
/// sums with such numbers those of other sensors lose all digits.
constexpr double kMaxVariance = 1e6;

/// Certainty: a double cannot tell the probability from 0 or 1, and sums fit into a float.
constexpr double kMaxLogOdds = 1000.0;

/// s, before or after the list's stamp: no sensor takes that long for one measurement.
constexpr double kMaxDelay = 10.0;

bool isPrecise(const Eigen::Matrix2d& covariance) {
  return isCovariance(covariance) && covariance.diagonal().maxCoeff() <= kMaxVariance;
}

bool isVelocity(const MeasuredVelocity& measured) {
  // NaN compares false with everything.
  return measured.velocity.norm() <= kMaxObjectSpeed && isPrecise(measured.covariance) &&
         isShare(measured.wrong_probability);
}

/// Covariance along two perpendicular axes that are turned by `rotation`.
Eigen::Matrix2d turned(const Eigen::Matrix2d& rotation, const Eigen::Matrix2d& covariance) {
  const Eigen::Matrix2d result = rotation * covariance * rotation.transpose();
  return 0.5 * (result + result.transpose());
}

bool areSides(const std::array<double, kBoxSides>& variances) {
  return std::all_of(variances.begin(), variances.end(), [](double variance) {
    return variance >= 0.0 && (variance <= kMaxVariance || std::isinf(variance));
  });
}

}  // namespace

bool isValid(const Object& object) {
  const Pose2& center = object.box.center;
  return isPosition(center.position()) && std::isfinite(center.heading()) &&
         isExtent(object.box.length) && isExtent(object.box.width) &&
         std::all_of(object.points.begin(), object.points.end(), isPosition) &&
         isAmount(object.heading_variance) && areSides(object.side_variance) &&
         std::abs(object.log_odds) <= kMaxLogOdds &&
         std::abs(object.motion_log_odds) <= kMaxLogOdds && isExtent(object.height) &&
         std::abs(object.delay) <= kMaxDelay && isShare(object.moving_fraction) &&
         areShares(object.class_probabilities) && isPrecise(object.position_covariance) &&
         (!object.velocity || isVelocity(*object.velocity));
}

Object transformed(const Pose2& frame_in_parent, const Object& object) {
  Object result = object;
  result.box.center = frame_in_parent * object.box.center;
  const Eigen::Matrix2d rotation = frame_in_parent.rotation();
  result.position_covariance = turned(rotation, object.position_covariance);
  if (object.velocity) {
    result.velocity->velocity = rotation * object.velocity->velocity;
    result.velocity->covariance = turned(rotation, object.velocity->covariance);
  }
  for (Point2& point : result.points) {
    point = frame_in_parent * point;
  }
  return result;
}

}  // namespace datmo
