// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "datmo_fusion/risk/risk_assessor.h"

namespace datmo {

/// A well-known car that drives straight along its velocity.
inline Track knownTrack(std::uint32_t id, const Point2& position, const Point2& velocity,
                        ObjectClass object_class = ObjectClass::kVehicle) {
  Track track;
  track.id = id;
  track.state.head<2>() = position;
  track.state.segment<2>(2) = velocity;
  track.covariance = 1e-4 * TrackCovariance::Identity();
  track.moving = velocity.norm() > 0.0;
  const auto mode = track.moving ? MotionMode::kConstantVelocity : MotionMode::kStanding;
  track.mode_probabilities[static_cast<std::size_t>(mode)] = 1.0;
  const double heading = track.moving ? std::atan2(velocity.y(), velocity.x()) : 0.0;
  const bool pedestrian = object_class == ObjectClass::kPedestrian;
  track.box = {Pose2(position, heading), pedestrian ? 0.6 : 4.0, pedestrian ? 0.6 : 1.8};
  track.heading_variance = 1e-4;
  track.class_probabilities[static_cast<std::size_t>(object_class)] = 1.0;
  track.existence_probability = 1.0;
  return track;
}

/// An oncoming car in its lane whose velocity is poorly known, and appears to lead across the road.
inline Track vagueOncoming(double across) {
  Track track = knownTrack(1, {40, 3.5}, {-10.0, -across});
  track.covariance.diagonal() << 1.0, 0.25, 1.0, 1.0, 1e-4, 1e-4;
  track.heading_variance = 0.04;
  return track;
}

/// A car that comes out of a side street on the left, ahead, and turns right into the road.
inline Track joiningCar(double off) {
  const Point2 velocity(-6.0 * std::cos(off), -6.0 * std::sin(off));
  Track track = knownTrack(1, {30.0, 6.0}, velocity);
  track.mode_probabilities = {0.4, 0.4, 0.02, 0.18, 0.0};
  return track;
}

/// A host at the origin that drives along x.
inline RiskInput inputAt(double speed, const std::vector<Track>& tracks = {}) {
  RiskInput input;
  input.stamp = Stamp::fromSeconds(100.0);
  input.host.speed = speed;
  input.tracks.stamp = input.stamp;
  input.tracks.tracks = tracks;
  return input;
}

/// Returns the risk of a track in a report; fails the test if there is none.
inline ObjectRisk riskOf(const RiskReport& report, std::uint32_t id) {
  for (const ObjectRisk& risk : report.objects) {
    if (risk.id == id) {
      return risk;
    }
  }
  ADD_FAILURE() << "no risk of track " << id;
  return {};
}

}  // namespace datmo
