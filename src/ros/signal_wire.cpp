// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/signal_wire.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>

#include <Eigen/Eigenvalues>
#include <boost/make_shared.hpp>

#include "datmo_fusion/fusion/earth/signal_times.h"
#include "datmo_fusion/fusion/wire/wire_error.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

/// Maximum number of stored intersections: more than are within radio range.
constexpr std::size_t kMaxIntersections = 100;

/// s; maximum backward step of a clock correction; a larger one is another time.
constexpr double kClockStep = 1.0;

double orNan(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

SignalAdviceMessagePtr toMessage(const SignalAdvice& advice, const IntersectionId& id,
                                 const std_msgs::Header& own) {
  auto message = boost::make_shared<SignalAdviceMessage>();
  message->header.stamp = own.stamp;
  message->verdict = static_cast<std::uint8_t>(advice.verdict);
  message->reason = advice.reason;
  message->region = static_cast<std::uint16_t>(id.region.value_or(0));
  message->intersection = static_cast<std::uint16_t>(id.number);
  message->distance = advice.distance;
  message->arrival = orNan(advice.arrival);
  message->deceleration = advice.deceleration;
  for (const MovementAdvice& one : advice.movements) {
    datmo_fusion::SignalMovement movement;
    movement.lane = static_cast<std::uint8_t>(one.lane);
    movement.group = static_cast<std::uint8_t>(one.group);
    movement.state = static_cast<std::uint8_t>(one.now);
    movement.state_on_arrival = static_cast<std::uint8_t>(one.on_arrival);
    movement.verdict = static_cast<std::uint8_t>(one.verdict);
    movement.min_end = orNan(one.min_end);
    movement.max_end = orNan(one.max_end);
    movement.likely_end = orNan(one.likely_end);
    message->movements.push_back(movement);
  }
  return message;
}

/// None if its state is not finite.
std::optional<ApproachingHost> hostOf(const StationTrack& track, Stamp stamp) {
  const Point2 ahead(std::cos(track.heading), std::sin(track.heading));
  ApproachingHost host;
  host.stamp = stamp;
  host.front = track.position + 0.5 * track.length * ahead;
  host.heading = track.heading;
  host.speed = track.velocity.dot(ahead);
  if (!host.front.allFinite() || !std::isfinite(host.speed) || !track.covariance.allFinite()) {
    return std::nullopt;
  }
  const Eigen::Matrix2d position = track.covariance.topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(position, Eigen::EigenvaluesOnly);
  host.position_sigma = std::sqrt(std::max(axes.eigenvalues().maxCoeff(), 0.0));
  const Eigen::Matrix2d velocity = track.covariance.bottomRightCorner<2, 2>();
  host.speed_sigma = std::sqrt(std::max(ahead.dot(velocity * ahead), 0.0));
  return host;
}

}  // namespace

void SignalWireOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"max_ahead", "s", "traffic lights with stamps farther ahead of our clock are rejected"},
      max_ahead, {0.0, 10.0});
  advice.visit(visitor);
}

SignalWire::SignalWire(const Checked<SignalWireOptions>& options, StageMonitor& monitor)
    : options_(*options), monitor_(monitor) {}

bool SignalWire::accepts(std::string_view bytes) {
  return bytes.size() > 1 && (bytes[1] == ItsHeader::kSpatem || bytes[1] == ItsHeader::kMapem);
}

void SignalWire::received(std::string_view bytes, Stamp now) {
  const bool is_map = bytes.size() > 1 && bytes[1] == ItsHeader::kMapem;
  monitor_.received(is_map ? "maps of intersections" : "traffic lights", now);
  if (last_ && secondsBetween(now, *last_) > kClockStep) {
    maps_.clear();
    signals_.clear();
  }
  last_ = now;
  try {
    is_map ? handleMaps(bytes, now) : handleSignals(bytes, now);
  } catch (const WireError& error) {
    monitor_.dropped(InputError(error.reason(), error.what()));
  }
  forgetOld(now);
  monitor_.figure("intersections with a map", static_cast<double>(maps_.size()));
  monitor_.figure("intersections with traffic lights", static_cast<double>(signals_.size()));
}

void SignalWire::handleMaps(std::string_view bytes, Stamp now) {
  for (const MapIntersection& intersection : decodeMapem(bytes).intersections) {
    maps_[intersection.id] = {now, intersection};
  }
}

void SignalWire::handleSignals(std::string_view bytes, Stamp now) {
  const Spatem message = decodeSpatem(bytes);
  for (const SpatIntersection& intersection : message.intersections) {
    try {
      keep(message, intersection, now);
    } catch (const InputError& error) {
      monitor_.dropped(error);
    }
  }
}

void SignalWire::keep(const Spatem& message, const SpatIntersection& intersection, Stamp now) {
  const Stamp stamp = stampOf(message, intersection, now).value_or(now);
  const double age = secondsBetween(stamp, now);
  const std::string who = "traffic lights of intersection " + toText(intersection.id);
  if (age > options_.advice.max_age) {
    throw InputError("old_signals",
                     who + ": " + std::to_string(age) + " s old, expected signals/max_age at most");
  }
  if (age < -options_.max_ahead) {
    throw InputError("future_signals",
                     who + ": " + std::to_string(-age) + " s ahead, expected synchronized clocks");
  }
  const auto known = signals_.find(intersection.id);
  if (known != signals_.end() && stamp <= known->second.stamp) {
    throw InputError("repeated_signals", who + ": not newer than the last ones");
  }
  signals_[intersection.id] = {stamp, intersection};
}

void SignalWire::forgetOld(Stamp now) {
  const auto forget = [now](auto& received, double max_age) {
    for (auto one = received.begin(); one != received.end();) {
      const bool is_old = secondsBetween(one->second.stamp, now) > max_age;
      one = is_old ? received.erase(one) : std::next(one);
    }
    while (received.size() > kMaxIntersections) {
      received.erase(std::min_element(
          received.begin(), received.end(),
          [](const auto& a, const auto& b) { return a.second.stamp < b.second.stamp; }));
    }
  };
  forget(maps_, options_.map_age);
  forget(signals_, options_.map_age);
}

SignalAdviceMessagePtr SignalWire::advise(const StationTracksMessage& own) {
  const std::optional<OwnTrack> us = ownTrack(own);
  const auto host = us ? hostOf(us->track, toStamp(own.header.stamp)) : std::nullopt;
  if (!host) {
    return nullptr;
  }
  std::optional<SignalAdvice> nearest;
  IntersectionId id;
  for (const auto& [number, map] : maps_) {
    if (secondsBetween(map.stamp, host->stamp) > options_.map_age) {
      continue;
    }
    const std::optional<SignalAdvice> advice = adviseAt(map.intersection, *host, us->plane);
    if (advice && (!nearest || advice->distance < nearest->distance)) {
      nearest = advice;
      id = number;
    }
  }
  return nearest ? toMessage(*nearest, id, own.header) : nullptr;
}

std::optional<SignalAdvice> SignalWire::adviseAt(const MapIntersection& intersection,
                                                 const ApproachingHost& host,
                                                 const LocalPlane& plane) {
  std::optional<SignalAdvice> advice;
  try {
    const auto found = signals_.find(intersection.id);
    const auto signals = found == signals_.end() ? std::nullopt : std::make_optional(found->second);
    const ApproachLanes approach = approachLanes(intersection, plane);
    advice = adviseSignals(host, approach.lanes, signals, options_.advice);
    if (advice && approach.left_out > 0) {  // the vehicle may be on one of these
      advice->verdict = SignalVerdict::kUnknown;
      advice->reason = "lanes_left_out";
      monitor_.warned(InputError(
          "lanes_left_out",
          "intersection " + toText(intersection.id) + " has " + std::to_string(approach.left_out) +
              " approach lanes whose geometry cannot be used: expected none; there is no verdict"));
    }
  } catch (const WireError& error) {
    monitor_.warned(InputError(error.reason(), error.what()));
  }
  return advice;
}

}  // namespace datmo
