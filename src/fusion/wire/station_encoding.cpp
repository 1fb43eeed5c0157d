// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "its_units.h"

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/fusion/wire/cam.h"
#include "datmo_fusion/fusion/wire/station_messages.h"
#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {

namespace {

/// At most 36 bytes each: below 1,400 bytes, the size of a datagram on Ethernet and ITS-G5.
constexpr std::size_t kObjectsPerMessage = 35;

/// Less likely classes are omitted.
constexpr double kMinClass = 0.01;

ItsPosition positionOf(const StationTrack& own, const Point2& front, const LocalPlane& plane) {
  const GeodeticPosition geodetic = plane.toGeodetic(front);
  ItsPosition position;
  position.latitude = toItsUnits(toDegrees(geodetic.latitude), kItsGeodetic, -900000000,
                                 ItsPosition::kNoLatitude - 1);
  position.longitude = toItsUnits(toDegrees(normalizeAngle(geodetic.longitude)), kItsGeodetic,
                                  -1800000000, ItsPosition::kNoLongitude - 1);
  setEllipse(own.covariance.topLeftCorner<2, 2>(), position);
  return position;
}

Cam camOf(const StationTrackList& list, const StationTrack& own, const ItsPosition& position,
          int leap_seconds) {
  Cam cam;
  cam.header.station = list.station;
  cam.generation_time = toGenerationTime(list.stamp, leap_seconds);
  cam.station_type = kItsPassengerCar;
  cam.position = position;
  cam.heading = toNorth(own.heading, own.heading_variance);
  const Point2 ahead(std::cos(own.heading), std::sin(own.heading));
  const double speed = own.velocity.norm();
  cam.speed.value = toItsUnits(speed, kItsCentimeter, 0, ItsSpeed::kNoValue - 1);
  const Eigen::Matrix2d velocity = own.covariance.bottomRightCorner<2, 2>();
  cam.speed.confidence = toItsConfidence(std::sqrt(ahead.dot(velocity * ahead)), kItsCentimeter,
                                         ItsSpeed::kOutOfRange);
  cam.direction = own.velocity.dot(ahead) < 0.0 ? Cam::kBackward : 0;
  cam.length = toItsUnits(own.length, kItsDecimeter, 1, Cam::kLengthOutOfRange);
  cam.width = toItsUnits(own.width, kItsDecimeter, 1, Cam::kWidthOutOfRange);
  return cam;
}

/// A class of the standard and its probability.
struct PossibleClass {
  CpmClass::Kind kind;
  CpmClass::Profile profile;
  double probability;
};

std::vector<CpmClass> classesOf(const ClassProbabilities& probabilities) {
  const auto of = [&](ObjectClass one) { return probabilities[static_cast<std::size_t>(one)]; };
  const std::array<PossibleClass, 4> possible{{
      {CpmClass::kVehicle, CpmClass::kPedestrian, of(ObjectClass::kVehicle)},
      {CpmClass::kVulnerable, CpmClass::kPedestrian, of(ObjectClass::kPedestrian)},
      {CpmClass::kVulnerable, CpmClass::kBicyclist, of(ObjectClass::kCyclist)},
      {CpmClass::kOther, CpmClass::kPedestrian, of(ObjectClass::kPole) + of(ObjectClass::kUnknown)},
  }};
  std::vector<CpmClass> classes;
  for (const PossibleClass& one : possible) {
    if (one.probability >= kMinClass) {
      classes.push_back({one.kind, one.profile, toItsUnits(one.probability, kItsPercent, 1, 100)});
    }
  }
  return classes;
}

CpmCoordinate coordinateOf(double value, double variance) {
  return {toItsUnits(value, kItsCentimeter, CpmCoordinate::kMin, CpmCoordinate::kMax),
          toItsConfidence(std::sqrt(variance), kItsCentimeter, CpmCoordinate::kOutOfRange)};
}

CpmVelocityComponent componentOf(double value, double variance) {
  return {toItsUnits(value, kItsCentimeter, CpmVelocityComponent::kMin, CpmVelocityComponent::kMax),
          toItsConfidence(std::sqrt(variance), kItsCentimeter, ItsSpeed::kOutOfRange)};
}

CpmObject objectOf(const StationTrack& track, const Point2& reference) {
  constexpr std::int64_t kIds = 65536;
  constexpr std::int64_t kMaxDimension = CpmObject::kDimensionOutOfRange;
  const Point2 position = track.position - reference;
  CpmObject object;
  object.id = (static_cast<std::int64_t>(track.id) - 1) % kIds;  // 0 is the own vehicle
  object.x = coordinateOf(position.x(), track.covariance(0, 0));
  object.y = coordinateOf(position.y(), track.covariance(1, 1));
  CpmVelocity velocity;
  velocity.x = componentOf(track.velocity.x(), track.covariance(2, 2));
  velocity.y = componentOf(track.velocity.y(), track.covariance(3, 3));
  object.velocity = velocity;
  object.heading = toEast(track.heading, track.heading_variance);
  object.length = toItsUnits(track.length, kItsDecimeter, 1, kMaxDimension);
  object.width = toItsUnits(track.width, kItsDecimeter, 1, kMaxDimension);
  if (track.height > 0.0) {
    object.height = toItsUnits(track.height, kItsDecimeter, 1, kMaxDimension);
  }
  object.quality =
      toItsUnits(static_cast<double>(CpmObject::kFullQuality) * track.existence_probability, 1.0, 1,
                 CpmObject::kFullQuality);
  object.classes = classesOf(track.class_probabilities);
  return object;
}

bool isInReach(const StationTrack& track, const Point2& reference) {
  constexpr double kReach = 1310.7;  // m, maximum of a coordinate
  return ((track.position - reference).array().abs() < kReach).all();
}

bool isFinite(const StationTrack& track) {
  return track.position.allFinite() && track.velocity.allFinite() && track.covariance.allFinite() &&
         (track.covariance.diagonal().array() >= 0.0).all() && std::isfinite(track.heading) &&
         std::isfinite(track.heading_variance) && std::isfinite(track.length) &&
         std::isfinite(track.width) && std::isfinite(track.existence_probability);
}

}  // namespace

std::vector<std::string> encodeStation(const StationTrackList& list, const LocalPlane& plane,
                                       const StationMessageOptions& options, bool low_frequency) {
  const auto own = std::find_if(list.tracks.begin(), list.tracks.end(),
                                [](const auto& track) { return track.id == 0 && isFinite(track); });
  if (own == list.tracks.end()) {
    throw WireError(
        "no_own_position",
        "tracks without our own vehicle: expected a pose on the earth to send to others");
  }
  const Point2 front =
      own->position + 0.5 * own->length * Point2(std::cos(own->heading), std::sin(own->heading));
  const ItsPosition position = positionOf(*own, front, plane);
  Cam cam = camOf(list, *own, position, options.leap_seconds);
  cam.has_low_frequency = low_frequency;
  std::vector<std::string> messages{encode(cam)};

  std::vector<CpmObject> objects;
  for (const StationTrack& track : list.tracks) {
    const bool is_sent = track.id != 0 && isFinite(track) && isInReach(track, front);
    if (is_sent && objects.size() < kObjectsPerMessage * Cpm::kMaxSegments) {
      objects.push_back(objectOf(track, front));
    }
  }
  Cpm cpm;
  cpm.header.station = list.station;
  cpm.reference_time = toItsTime(list.stamp, options.leap_seconds);
  cpm.position = position;
  cpm.orientation = cam.heading;
  cpm.object_count = std::min(static_cast<std::int64_t>(objects.size()), Cpm::kMaxObjects);
  const std::size_t segments =
      std::max<std::size_t>(1, (objects.size() + kObjectsPerMessage - 1) / kObjectsPerMessage);
  cpm.segments = static_cast<std::int64_t>(segments);
  for (std::size_t i = 0; i < segments; ++i) {
    const auto first = objects.begin() + static_cast<std::ptrdiff_t>(i * kObjectsPerMessage);
    const auto last = objects.begin() + static_cast<std::ptrdiff_t>(
                                            std::min(objects.size(), (i + 1) * kObjectsPerMessage));
    cpm.segment = static_cast<std::int64_t>(i + 1);
    cpm.objects.assign(first, last);
    messages.push_back(encode(cpm, options.dictionary));
  }
  return messages;
}

}  // namespace datmo
