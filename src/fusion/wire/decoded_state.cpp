// SPDX-License-Identifier: BSD-3-Clause
#include "decoded_state.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {

namespace {

/// Length and width, m, of an object whose size is not reported.
struct UsualSize {
  double length = 0.0;
  double width = 0.0;
};

UsualSize usualSize(ObjectClass object_class) {
  switch (object_class) {
    case ObjectClass::kVehicle:
      return {4.5, 1.8};
    case ObjectClass::kCyclist:
      return {1.8, 0.6};
    case ObjectClass::kPedestrian:
    case ObjectClass::kPole:
    case ObjectClass::kUnknown:
      break;
  }
  return {0.5, 0.5};
}

}  // namespace

ReferencePosition referencePositionOf(const ItsPosition& position,
                                      const StationMessageOptions& options) {
  const std::optional<Eigen::Matrix2d> covariance = fromEllipse(position, options.position_sigma);
  if (position.latitude == ItsPosition::kNoLatitude ||
      position.longitude == ItsPosition::kNoLongitude || !covariance) {
    throw WireError("no_position",
                    "a station whose position is unknown, or known only to 41 m: dropped");
  }
  GeodeticPosition geodetic = geodeticOf(position.latitude, position.longitude);
  geodetic.altitude = position.altitude == ItsPosition::kNoAltitude
                          ? 0.0
                          : kItsCentimeter * static_cast<double>(position.altitude);
  return {LocalPlane(geodetic), *covariance};
}

Velocity unknownVelocity(const StationMessageOptions& options) {
  return {Point2::Zero(), square(options.unknown_speed_sigma) * Eigen::Matrix2d::Identity(), false};
}

Velocity velocityOf(const ItsSpeed& speed, const std::optional<ItsDirection>& course,
                    const StationMessageOptions& options) {
  const std::optional<double> sigma = fromItsConfidence(speed.confidence, kItsCentimeter,
                                                        ItsSpeed::kOutOfRange, options.speed_sigma);
  if (speed.value == ItsSpeed::kNoValue || !sigma) {
    return unknownVelocity(options);
  }
  const double ahead = kItsCentimeter * static_cast<double>(speed.value);
  if (!course) {
    const double variance = square(*sigma) + 0.5 * square(ahead);
    return {Point2::Zero(), variance * Eigen::Matrix2d::Identity(), ahead < kStandstill};
  }
  const Point2 along(std::cos(course->angle), std::sin(course->angle));
  const Eigen::Matrix2d along_variance = along * along.transpose();
  // At low speed the lateral uncertainty is as large as the longitudinal one.
  const double across = std::max(square(ahead * course->sigma), square(*sigma));
  return {ahead * along,
          square(*sigma) * along_variance + across * (Eigen::Matrix2d::Identity() - along_variance),
          true};
}

void setVelocity(const Velocity& velocity, StationTrack& track) {
  track.velocity = velocity.velocity;
  track.covariance.bottomRightCorner<2, 2>() = velocity.covariance;
  track.moving = !velocity.is_known || velocity.velocity.norm() >= kStandstill;
}

void setSize(ObjectClass object_class, StationTrack& track) {
  const UsualSize usual = usualSize(object_class);
  track.length = track.length > 0.0 ? track.length : usual.length;
  track.width = track.width > 0.0 ? track.width : usual.width;
}

}  // namespace datmo
