#include "datmo_fusion/tracking/object_check.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

/// A larger difference, relative to the variances, is not rounding: the matrix is not a covariance.
constexpr double kAsymmetry = 1e-6;

/// Nothing on the ground is farther away or larger, m: squares of such lengths stay far from the
/// limits of a double.
constexpr double kFarthest = 1e9;

/// s, before or after its list's stamp: no sensor takes as long for one measurement.
constexpr double kLongestDelay = 10.0;

/// NaN compares false with everything, and so is nowhere.
bool isPlace(const Point2& point) {
  return std::abs(point.x()) <= kFarthest && std::abs(point.y()) <= kFarthest;
}

/// Finite, and not negative.
bool isAmount(double value) { return std::isfinite(value) && value >= 0.0; }

bool isLength(double value) { return value >= 0.0 && value <= kFarthest; }

bool isShare(double value) { return value >= 0.0 && value <= 1.0; }

bool areSides(const std::array<double, kBoxSides>& variances) {
  return std::all_of(variances.begin(), variances.end(),
                     [](double variance) { return variance >= 0.0; });
}

bool isCovariance(const Eigen::Matrix2d& matrix) {
  const double trace = matrix.trace();
  return std::isfinite(matrix.sum()) && matrix(0, 0) > 0.0 &&
         std::abs(matrix(0, 1) - matrix(1, 0)) <= kAsymmetry * trace &&
         matrix(0, 0) * matrix(1, 1) - matrix(0, 1) * matrix(1, 0) > 0.0;
}

}  // namespace

bool isValid(const Object& object) {
  const Pose2& centre = object.box.centre;
  return isPlace(centre.position()) && std::isfinite(centre.heading()) &&
         isLength(object.box.length) && isLength(object.box.width) &&
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
