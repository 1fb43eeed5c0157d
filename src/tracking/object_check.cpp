#include "datmo_fusion/tracking/object_check.h"

#include <algorithm>
#include <cmath>

#include "number_checks.h"

namespace datmo {

namespace {

/// s, before or after its list's stamp: no sensor takes as long for one measurement.
constexpr double kLongestDelay = 10.0;

bool areSides(const std::array<double, kBoxSides>& variances) {
  return std::all_of(variances.begin(), variances.end(),
                     [](double variance) { return variance >= 0.0; });
}

}  // namespace

bool isValid(const Object& object) {
  const Pose2& centre = object.box.centre;
  return isPlace(centre.position()) && std::isfinite(centre.heading()) &&
         isModerateAmount(object.box.length) && isModerateAmount(object.box.width) &&
         std::all_of(object.points.begin(), object.points.end(), isPlace) &&
         isAmount(object.heading_variance) && areSides(object.side_variance) &&
         std::isfinite(object.log_odds) && isAmount(object.height) &&
         std::abs(object.delay) <= kLongestDelay && isShare(object.moving_fraction) &&
         isShare(object.class_probability) && isCovariance(object.position_covariance);
}

Object transformed(const Pose2& frame_in_parent, const Object& object) {
  Object result = object;
  result.box.centre = frame_in_parent * object.box.centre;
  const Eigen::Matrix2d rotation = frame_in_parent.rotation();
  const Eigen::Matrix2d turned = rotation * object.position_covariance * rotation.transpose();
  result.position_covariance = 0.5 * (turned + turned.transpose());
  for (Point2& point : result.points) {
    point = frame_in_parent * point;
  }
  return result;
}

}  // namespace datmo
