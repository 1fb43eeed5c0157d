// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "decoded_state.h"

#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {

namespace {

/// Probability that a station is what it reports.
constexpr double kSureClass = 0.95;

/// The probability of a class; the others share the rest.
ClassProbabilities likely(ObjectClass object_class, double probability) {
  ClassProbabilities probabilities;
  probabilities.fill((1.0 - probability) / static_cast<double>(kObjectClasses));
  probabilities[static_cast<std::size_t>(object_class)] += probability;
  return probabilities;
}

ObjectClass classOf(std::int64_t station_type) {
  switch (station_type) {
    case kItsPedestrian:
      return ObjectClass::kPedestrian;
    case kItsCyclist:
    case kItsMoped:
    case kItsMotorcycle:
    case kItsLightVruVehicle:
      return ObjectClass::kCyclist;
    default:
      break;
  }
  const bool is_vehicle = (station_type >= kItsPassengerCar && station_type <= kItsTram) ||
                          station_type == kItsAgricultural;
  return is_vehicle ? ObjectClass::kVehicle : ObjectClass::kUnknown;
}

/// A vehicle reports the middle of its front (EN 302 637-2, B.19).
void moveToCenter(const std::optional<ItsDirection>& heading, StationTrack& track) {
  const double half = 0.5 * track.length;
  Eigen::Matrix2d covariance = square(half) / 3.0 * Eigen::Matrix2d::Identity();
  if (heading) {
    const Point2 ahead(std::cos(heading->angle), std::sin(heading->angle));
    const Point2 left = perpendicular(ahead);
    track.position -= half * ahead;
    covariance = square(half * heading->sigma) * left * left.transpose();
  }
  track.covariance.topLeftCorner<2, 2>() += covariance;
}

}  // namespace

StationMessage decode(const Cam& cam, Stamp now, const StationMessageOptions& options) {
  const ReferencePosition reference = referencePositionOf(cam.position, options);
  if (!cam.is_vehicle) {
    throw WireError("no_track", "a CAM of a roadside unit, which is not a track: dropped");
  }
  const std::optional<ItsDirection> heading = fromNorth(cam.heading, options.heading_sigma);
  StationTrack track;
  track.covariance.setZero();
  track.covariance.topLeftCorner<2, 2>() = reference.covariance;
  Velocity velocity = velocityOf(cam.speed, heading, options);
  velocity.velocity *= cam.direction == Cam::kBackward ? -1.0 : 1.0;
  setVelocity(velocity, track);
  if (heading) {
    track.heading = heading->angle;
    track.heading_variance = square(heading->sigma);
  }
  const ObjectClass object_class = classOf(cam.station_type);
  track.class_probabilities = likely(object_class, kSureClass);
  track.length =
      cam.length >= Cam::kLengthOutOfRange ? 0.0 : kItsDecimeter * static_cast<double>(cam.length);
  track.width =
      cam.width >= Cam::kWidthOutOfRange ? 0.0 : kItsDecimeter * static_cast<double>(cam.width);
  setSize(object_class, track);
  if (cam.station_type >= kItsMoped && cam.station_type <= kItsTram) {
    moveToCenter(heading, track);
  }
  StationMessage message{reference.plane, {}, 0};
  message.list.stamp = fromGenerationTime(cam.generation_time, now, options.leap_seconds);
  message.list.station = static_cast<std::uint32_t>(cam.header.station);
  message.list.tracks = {track};
  return message;
}

}  // namespace datmo
