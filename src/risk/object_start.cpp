// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/object_start.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Density of the velocity across the road where all directions are alike, s/m: that of a
/// projected circle at its middle.
double densityOfAnyDirection(double speed) { return 1.0 / (kPi * speed); }

double normalDensity(double value, double variance) {
  return std::exp(-0.5 * square(value) / variance) / std::sqrt(kTurn * variance);
}

/// Of who drives or rides, of what may be anything.
double shareOfDrivers(const Track& track) {
  const auto share = [&](ObjectClass kind) {
    return track.class_probabilities[static_cast<std::size_t>(kind)];
  };
  return std::min(1.0, share(ObjectClass::kVehicle) + share(ObjectClass::kCyclist));
}

/// A smaller share of the modes cannot be told from none: messages have each in single precision
/// (6e-8), and it is what is left of 1.
constexpr double kMinStraight = 1e-6;

/// How much likelier the measurements are of what turns as often as others do than of what never
/// does: its modes without and with them. 1: the modes are not known.
double turnEvidence(const Track& track, double turn_share) {
  const auto share = [&](MotionMode mode) {
    return track.mode_probabilities[static_cast<std::size_t>(mode)];
  };
  const auto& modes = track.mode_probabilities;
  if (std::accumulate(modes.begin(), modes.end(), 0.0) <= 0.0) {
    return 1.0;
  }
  const double straight = 1.0 - share(MotionMode::kLeftTurn) - share(MotionMode::kRightTurn);
  return (1.0 - turn_share) / std::max(straight, kMinStraight);
}

/// The direction along the road that is nearer to the heading, rad.
double alongRoad(double road, double heading) {
  const double off = angleBetween(road, heading);
  return std::abs(off) <= kQuarterTurn ? road : normalizeAngle(road + kPi);
}

}  // namespace

void RoadFollowingOptions::visit(OptionVisitor& visitor) {
  visitor.number({"probability", "1",
                  "prior probability that who drives or rides keeps to the direction of the road; "
                  "0: the track's velocity alone"},
                 probability, {0.0, 0.999});
  visitor.number({"direction_sigma", "rad",
                  "standard deviation of his course about it: swaying, and bends beyond what is "
                  "known of the road"},
                 direction_sigma, {0.001, 1.0});
  visitor.number({"min_speed", "m/s", "slower objects have no measurable course"}, min_speed,
                 {0.1, 10.0});
}

ObjectStart startOf(const Track& track, double max_heading_sigma) {
  return {track.state, track.covariance.llt().matrixL(), track.box.center.heading(),
          std::min(max_heading_sigma, std::sqrt(track.heading_variance))};
}

std::optional<RoadFollower> roadFollower(const Track& track, const ObjectStart& start, double road,
                                         double turn_share, const RoadFollowingOptions& options) {
  const double prior = options.probability * shareOfDrivers(track);
  const double speed = track.state.segment<2>(2).norm();
  if (prior <= 0.0 || speed < options.min_speed) {
    return std::nullopt;
  }
  Eigen::Matrix<double, 1, kTrackState> across = Eigen::Matrix<double, 1, kTrackState>::Zero();
  across.segment<2>(2) = perpendicular({std::cos(road), std::sin(road)}).transpose();
  const double off = across * track.state;
  const TrackState covariance = track.covariance * across.transpose();
  const double variance = (across * covariance).value() + square(options.direction_sigma * speed);
  const double follows = prior * normalDensity(off, variance);
  const double other = (1.0 - prior) * densityOfAnyDirection(std::max(speed, std::sqrt(variance))) *
                       turnEvidence(track, turn_share);
  const TrackState gain = covariance / variance;
  // Joseph's form stays positive definite.
  const TrackCovariance keep = TrackCovariance::Identity() - gain * across;
  const TrackCovariance conditioned =
      keep * track.covariance * keep.transpose() +
      square(options.direction_sigma * speed) * gain * gain.transpose();
  const double heading_share =
      square(start.heading_sigma) / (square(start.heading_sigma) + square(options.direction_sigma));
  RoadFollower follower;
  follower.start.state = start.state - gain * off;
  follower.start.root = conditioned.llt().matrixL();
  follower.start.heading =
      start.heading + heading_share * angleBetween(start.heading, alongRoad(road, start.heading));
  follower.start.heading_sigma = start.heading_sigma * std::sqrt(1.0 - heading_share);
  follower.probability = follows / (follows + other);
  return follower;
}

}  // namespace datmo
