// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/object_start.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/normal_density.h"
#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Returns the density of the velocity across the road if all directions are equally likely, s/m:
/// that of a projected circle at its center.
double densityOfAnyDirection(double speed) { return 1.0 / (kPi * speed); }

/// Returns the probability that a moving object is a driver or rider: it is not a pole, and an
/// unknown class is any of the others.
double shareOfDrivers(const Track& track) {
  const auto share = [&](ObjectClass kind) {
    return track.class_probabilities[static_cast<std::size_t>(kind)];
  };
  const double drivers = share(ObjectClass::kVehicle) + share(ObjectClass::kCyclist);
  return drivers > 0.0 ? drivers / (drivers + share(ObjectClass::kPedestrian)) : 0.0;
}

/// A smaller share of the modes cannot be distinguished from 0: messages have each in single
/// precision (6e-8), and it is the remainder to 1.
constexpr double kMinStraight = 1e-6;

/// Returns the likelihood ratio of an object that turns as often as others over one that never
/// does, from its mode probabilities. 1: the modes are unknown.
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

/// Returns the likelihood ratio of an object that turns to one side over one that turns as often as
/// others. 1: the modes are unknown.
double sideEvidence(const Track& track, MotionMode side, double turn_share) {
  const auto& modes = track.mode_probabilities;
  return std::accumulate(modes.begin(), modes.end(), 0.0) <= 0.0
             ? 1.0
             : modes[static_cast<std::size_t>(side)] / (0.5 * turn_share);
}

/// Returns the share of drivers not following the road that turn into it: Bayes over those that
/// cross it, straight and at about a right angle, and those that turn into it or off it, at any
/// angle, according to the side to which the modes turn.
double shareOfJoining(const Track& track, double road, double turn_share,
                      const RoadFollowingOptions& options) {
  const double into = turnIntoRoad(std::atan2(track.state[3], track.state[2]), road);
  const double left = sideEvidence(track, MotionMode::kLeftTurn, turn_share);
  const double right = sideEvidence(track, MotionMode::kRightTurn, turn_share);
  const double each = 0.5 * options.turning / kQuarterTurn;  // per angle, up to a right angle
  const double joins = each * (into > 0.0 ? left : right);
  const double leaves = each * (into > 0.0 ? right : left);
  const double from_right_angle = kQuarterTurn - std::abs(into);  // one half of a Gaussian
  const double crosses = (1.0 - options.turning) * 2.0 *
                         normalDensity(from_right_angle, square(options.crossing_sigma)) /
                         turnEvidence(track, turn_share);
  const double all = joins + leaves + crosses;
  return all > 0.0 ? joins / all : 0.0;
}

}  // namespace

double turnIntoRoad(double course, double road) {
  const double turn = angleBetween(course, road);
  return std::abs(turn) <= kQuarterTurn ? turn : angleBetween(course, road + kPi);
}

void RoadFollowingOptions::visit(OptionVisitor& visitor) {
  visitor.number({"probability", "1",
                  "prior probability that a driver or rider follows the direction of the road; 0: "
                  "the track's velocity alone is used"},
                 probability, {0.0, 0.999});
  visitor.number({"turning", "1",
                  "share of the drivers not following the road that turn into it or off it; the "
                  "others cross it"},
                 turning, {0.0, 1.0});
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
  // Joseph form: remains positive definite.
  const TrackCovariance keep = TrackCovariance::Identity() - gain * across;
  const TrackCovariance conditioned =
      keep * track.covariance * keep.transpose() +
      square(options.direction_sigma * speed) * gain * gain.transpose();
  const double heading_share =
      square(start.heading_sigma) / (square(start.heading_sigma) + square(options.direction_sigma));
  RoadFollower follower;
  follower.start.state = start.state - gain * off;
  follower.start.root = conditioned.llt().matrixL();
  follower.start.heading = start.heading + heading_share * turnIntoRoad(start.heading, road);
  follower.start.heading_sigma = start.heading_sigma * std::sqrt(1.0 - heading_share);
  follower.probability = follows / (follows + other);
  const double drives =
      (shareOfDrivers(track) - prior) / (1.0 - prior);  // among those that do not follow
  follower.joining =
      (1.0 - follower.probability) * drives * shareOfJoining(track, road, turn_share, options);
  return follower;
}

}  // namespace datmo
