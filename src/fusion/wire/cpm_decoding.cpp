// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>

#include "decoded_state.h"

#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

constexpr double kMillisecond = 1e-3;  // s

/// Probability of a class whose confidence is not available.
constexpr double kLikelyClass = 0.5;

ObjectClass classOf(const CpmClass& one) {
  if (one.kind == CpmClass::kVehicle) {
    return ObjectClass::kVehicle;
  }
  if (one.kind != CpmClass::kVulnerable || one.profile == CpmClass::kAnimal) {
    return ObjectClass::kUnknown;
  }
  return one.profile == CpmClass::kPedestrian ? ObjectClass::kPedestrian : ObjectClass::kCyclist;
}

ClassProbabilities classesOf(const std::vector<CpmClass>& classes) {
  ClassProbabilities probabilities{};
  for (const CpmClass& one : classes) {
    probabilities[static_cast<std::size_t>(classOf(one))] +=
        one.confidence == CpmClass::kNoConfidence
            ? kLikelyClass
            : kItsPercent * static_cast<double>(one.confidence);
  }
  const double sum = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
  const double rest = std::max(0.0, 1.0 - sum) / static_cast<double>(kObjectClasses);
  for (double& probability : probabilities) {
    probability = probability / std::max(1.0, sum) + rest;
  }
  return probabilities;
}

Velocity velocityOf(const CpmVelocity& velocity, const StationMessageOptions& options) {
  if (velocity.is_polar) {
    return velocityOf(velocity.speed, fromEast(velocity.course, options.heading_sigma), options);
  }
  Velocity found;
  found.is_known = true;
  int axis = 0;
  for (const CpmVelocityComponent& component : {velocity.x, velocity.y}) {
    const std::optional<double> sigma = fromItsConfidence(
        component.confidence, kItsCentimeter, ItsSpeed::kOutOfRange, options.speed_sigma);
    if (component.value == CpmVelocityComponent::kNoValue || !sigma) {
      return unknownVelocity(options);
    }
    found.velocity(axis) = kItsCentimeter * static_cast<double>(component.value);
    found.covariance(axis, axis) = square(*sigma);
    ++axis;
  }
  return found;
}

double dimensionOf(const std::optional<std::int64_t>& dimension) {
  return dimension.value_or(CpmObject::kNoDimension) >= CpmObject::kDimensionOutOfRange
             ? 0.0
             : kItsDecimeter * static_cast<double>(*dimension);
}

/// Uses the heading of the message; otherwise that of the motion, if known.
void setHeading(const CpmObject& object, const StationMessageOptions& options,
                StationTrack& track) {
  std::optional<ItsDirection> heading;
  if (object.heading) {
    heading = fromEast(*object.heading, options.heading_sigma);
  }
  const double speed2 = track.velocity.squaredNorm();
  if (heading) {
    track.heading = heading->angle;
    track.heading_variance = square(heading->sigma);
  } else if (track.moving && speed2 > square(kStandstill)) {
    const double variance = 0.5 * track.covariance.bottomRightCorner<2, 2>().trace() / speed2;
    track.heading = std::atan2(track.velocity.y(), track.velocity.x());
    track.heading_variance = std::min(kUnknownHeadingVariance, variance);
  }
}

/// Returns none if its position is out of range.
std::optional<Eigen::Matrix2d> setPosition(const CpmObject& object,
                                           const StationMessageOptions& options,
                                           StationTrack& track) {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  int axis = 0;
  for (const CpmCoordinate& coordinate : {object.x, object.y}) {
    const std::optional<double> sigma =
        fromItsConfidence(coordinate.confidence, kItsCentimeter, CpmCoordinate::kOutOfRange,
                          options.object_position_sigma);
    if (coordinate.value == CpmCoordinate::kMin || coordinate.value == CpmCoordinate::kMax ||
        !sigma) {
      return std::nullopt;
    }
    track.position(axis) = kItsCentimeter * static_cast<double>(coordinate.value);
    covariance(axis, axis) = square(*sigma);
    ++axis;
  }
  return covariance;
}

/// The track at the reference time; none without id or position.
std::optional<StationTrack> trackOf(const CpmObject& object, const Eigen::Matrix2d& reference,
                                    const StationMessageOptions& options) {
  StationTrack track;
  track.covariance.setZero();
  const std::optional<Eigen::Matrix2d> position = setPosition(object, options, track);
  if (!object.id || !position) {
    return std::nullopt;
  }
  track.id = static_cast<std::uint32_t>(*object.id + 1);  // 0 is the station itself
  setVelocity(object.velocity ? velocityOf(*object.velocity, options) : unknownVelocity(options),
              track);
  const double delay = kMillisecond * static_cast<double>(object.delay);
  const Eigen::Matrix2d velocity = track.covariance.bottomRightCorner<2, 2>();
  track.position -= delay * track.velocity;
  track.covariance.topLeftCorner<2, 2>() = reference + *position + square(delay) * velocity;
  track.covariance.topRightCorner<2, 2>() = -delay * velocity;
  track.covariance.bottomLeftCorner<2, 2>() = -delay * velocity;
  setHeading(object, options, track);
  track.length = dimensionOf(object.length);
  track.width = dimensionOf(object.width);
  track.height = dimensionOf(object.height);
  track.class_probabilities = classesOf(object.classes);
  setSize(mostLikelyClass(track.class_probabilities), track);
  const std::int64_t quality = object.quality.value_or(0);  // 0: could not be computed
  track.existence_probability =
      quality == 0 ? options.existence
                   : static_cast<double>(quality) / static_cast<double>(CpmObject::kFullQuality);
  return track;
}

}  // namespace

StationMessage decode(const Cpm& cpm, const StationMessageOptions& options) {
  const ReferencePosition reference = referencePositionOf(cpm.position, options);
  StationMessage message{reference.plane, {}, 0};
  message.list.stamp = fromItsTime(cpm.reference_time, options.leap_seconds);
  message.list.station = static_cast<std::uint32_t>(cpm.header.station);
  message.list.part = static_cast<std::uint32_t>(cpm.segment);
  for (const CpmObject& object : cpm.objects) {
    if (const std::optional<StationTrack> track = trackOf(object, reference.covariance, options)) {
      message.list.tracks.push_back(*track);
    } else {
      ++message.left_out;
    }
  }
  return message;
}

}  // namespace datmo
