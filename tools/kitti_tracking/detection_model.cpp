// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/detection_model.h"

#include <cmath>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/square.h"

namespace datmo::kitti {

namespace {

ObjectClass classOf(ObjectType type) {
  switch (type) {
    case ObjectType::kCar:
      return ObjectClass::kVehicle;
    case ObjectType::kPedestrian:
      return ObjectClass::kPedestrian;
    case ObjectType::kCyclist:
      return ObjectClass::kCyclist;
    default:
      return ObjectClass::kUnknown;
  }
}

/// Covariance of a position seen in this direction (rad), of the axes along and across the line of
/// sight.
Eigen::Matrix2d covarianceOf(double direction, double along, double across) {
  const Eigen::Matrix2d axes = Pose2(Point2::Zero(), direction).rotation();
  return axes * Point2(square(along), square(across)).asDiagonal() * axes.transpose();
}

}  // namespace

void DetectionModelOptions::visit(OptionVisitor& visitor) {
  constexpr Bounds kSigma{0.001, 5.0};
  constexpr Bounds kPerMeter{0.0, 0.1};
  visitor.number(
      {"score_slope", "1", "increase of the log odds that a detection is true with its score"},
      score_slope, {0.01, 100.0});
  visitor.number({"score_even", "1", "score at which a detection is as often true as false"},
                 score_even, {-100.0, 100.0});
  visitor.number({"along_sigma", "m",
                  "standard deviation of the center along the line of sight, at the sensor"},
                 along_sigma, kSigma);
  visitor.number({"along_per_meter", "1", "increase of along_sigma per meter of range"},
                 along_per_meter, kPerMeter);
  visitor.number({"across_sigma", "m",
                  "standard deviation of the center across the line of sight, at the sensor"},
                 across_sigma, kSigma);
  visitor.number({"across_per_meter", "1", "increase of across_sigma per meter of range"},
                 across_per_meter, kPerMeter);
  visitor.number({"length_sigma", "m",
                  "standard deviation of the length, in addition to errors of the whole box"},
                 length_sigma, kSigma);
  visitor.number({"width_sigma", "m", "the same of the width"}, width_sigma, kSigma);
  visitor.number({"heading_sigma", "rad", "standard deviation of the heading modulo pi"},
                 heading_sigma, {0.001, 1.5});
  visitor.number({"sure_range", "m",
                  "up to this range the detector finds everything that is not hidden, beyond it "
                  "less and less"},
                 sure_range, {1.0, 500.0});
  visitor.number({"range", "m", "the detector finds nothing beyond this range"}, range,
                 {1.0, 500.0});
}

DetectionModel::DetectionModel(const DetectionModelOptions& options) : options_(options) {
  checkOptions(options);
}

Object DetectionModel::object(const Detection& detection, const CameraMount& mount) const {
  Object object;
  object.box = mount.onGround(detection.box);
  const Point2 ray = object.box.center.position() - mount.cameraInBase().position();
  const double range = ray.norm();
  object.position_covariance = covarianceOf(
      std::atan2(ray.y(), ray.x()), options_.along_sigma + range * options_.along_per_meter,
      options_.across_sigma + range * options_.across_per_meter);
  object.heading_variance = square(options_.heading_sigma);
  // Either of two opposite sides has half of the variance of the size between them.
  const double end = 0.5 * square(options_.length_sigma);
  const double side = 0.5 * square(options_.width_sigma);
  object.side_variance = {end, end, side, side};
  object.height = detection.box.height;
  object.class_probabilities = reportedClass(classOf(detection.type), 1.0);
  object.log_odds = logOdds(detection.score);
  return object;
}

FieldOfView DetectionModel::view(const CameraMount& mount) const {
  return {mount.cameraInBase(), mount.minBearing(), mount.maxBearing(), options_.sure_range,
          options_.range};
}

}  // namespace datmo::kitti
