// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/true_tracks.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace datmo::simulator {

namespace {

/// s, over which true accelerations and yaw rates are averaged.
constexpr double kShort = 0.1;

/// s, the same of the host (HostInputOptions::acceleration_time).
constexpr double kHostTime = 0.5;

/// Standard deviations of an ideal track: m, m/s, m/s^2, rad.
constexpr double kPositionSigma = 0.1;
constexpr double kVelocitySigma = 0.1;
constexpr double kAccelerationSigma = 0.2;
constexpr double kHeadingSigma = 0.02;

/// m, between points on the outlines of stationary solids.
constexpr double kPointSpacing = 0.2;

/// Probability of the mode of the true motion; the others share the rest.
constexpr double kSureMode = 0.9;

/// m/s, m/s^2, rad/s; above these: motion, acceleration, a turn.
constexpr double kMoving = 0.1;
constexpr double kAccelerating = 0.5;
constexpr double kTurning = 0.1;

MotionMode modeOf(const Track& track) {
  const Point2 velocity = track.state.segment<2>(2);
  if (velocity.norm() < kMoving) {
    return MotionMode::kStanding;
  }
  if (std::abs(track.yaw_rate) > kTurning) {
    return track.yaw_rate > 0.0 ? MotionMode::kLeftTurn : MotionMode::kRightTurn;
  }
  const double along = velocity.normalized().dot(track.state.tail<2>());
  return std::abs(along) > kAccelerating ? MotionMode::kConstantAcceleration
                                         : MotionMode::kConstantVelocity;
}

TrackCovariance idealCovariance() {
  TrackState sigmas;
  sigmas << kPositionSigma, kPositionSigma, kVelocitySigma, kVelocitySigma, kAccelerationSigma,
      kAccelerationSigma;
  return sigmas.cwiseAbs2().asDiagonal();
}

Track trackOf(const ObjectState& now, const ObjectState& before, double seconds) {
  Track track;
  track.id = now.id;
  track.state.head<2>() = now.center.position();
  track.state.segment<2>(2) = now.velocity;
  track.covariance = idealCovariance();
  track.box = now.box();
  track.height = now.kind.height;
  track.heading_variance = kHeadingSigma * kHeadingSigma;
  if (seconds > 0.0) {
    track.state.tail<2>() = (now.velocity - before.velocity) / seconds;
    track.yaw_rate = angleBetween(before.center.heading(), now.center.heading()) / seconds;
  }
  track.moving = now.velocity.norm() >= kMoving;
  track.mode_probabilities.fill((1.0 - kSureMode) / (kMotionModes - 1));
  track.mode_probabilities[static_cast<std::size_t>(modeOf(track))] = kSureMode;
  track.class_probabilities[static_cast<std::size_t>(now.kind.object_class)] = 1.0;
  track.existence_probability = 1.0;
  return track;
}

void addOutline(const Box2& box, std::vector<Point2>& points) {
  const std::array<Point2, 4> corners = box.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2& from = corners[i];
    const Point2& to = corners[(i + 1) % corners.size()];
    const double length = (to - from).norm();
    for (double along = 0.0; along < length; along += kPointSpacing) {
      points.push_back(from + along / length * (to - from));
    }
  }
}

}  // namespace

HostState trueHost(const World& world, double time, const HostVehicleOptions& vehicle) {
  const WorldState now = world.at(time);
  const double before = std::max(0.0, time - kHostTime);
  HostState host;
  host.pose = now.base;
  host.speed = now.twist.forward_speed;
  host.steering = steeringOf(now.twist.forward_speed, now.twist.yaw_rate, vehicle);
  if (time > before) {
    host.acceleration =
        (now.twist.forward_speed - world.at(before).twist.forward_speed) / (time - before);
  }
  return host;
}

TruePerception IdealTracker::at(double time, const std::vector<ObjectTruth>& truths) {
  const double earlier = std::max(0.0, time - kShort);
  const WorldState before = world_.at(earlier);
  TruePerception perception;
  for (const ObjectTruth& truth : truths) {
    const ObjectState& now = truth.state;
    if (!truth.visible_to.empty()) {
      seen_.insert(now.id);
    }
    if (seen_.count(now.id) == 0) {
      continue;
    }
    if (now.velocity.norm() >= kMoving) {
      moved_.insert(now.id);
    }
    if (moved_.count(now.id) == 0) {
      addOutline(now.box(), perception.standing);
      continue;
    }
    const auto then =
        std::find_if(before.objects.begin(), before.objects.end(),
                     [&now](const ObjectState& object) { return object.id == now.id; });
    if (then != before.objects.end()) {
      perception.tracks.push_back(trackOf(now, *then, time - earlier));
    }
  }
  return perception;
}

}  // namespace datmo::simulator
