// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/object_futures.h"

#include <cmath>
#include <optional>
#include <vector>

#include "risk/risk_samples.h"
#include <gtest/gtest.h>

namespace datmo::object_futures_test {
namespace {

const HorizonOptions kHorizon;
const RandomDraws kDraws(1);

/// Sojourn times so long that no mode is left.
ObjectFutureOptions withoutSwitching() {
  ObjectFutureOptions options;
  options.transitions.straight_sojourn = 1e6;
  options.transitions.accelerating_sojourn = 1e6;
  options.transitions.turn_sojourn = 1e6;
  options.transitions.standing_sojourn = 1e6;
  return options;
}

struct Spread {
  Point2 mean = Point2::Zero();
  double sigma = 0.0;  ///< m, root of the mean squared distance from the mean
};

Spread endsOf(const ObjectFutures& futures) {
  std::vector<Point2> ends;
  Spread spread;
  for (int i = 0; i < kHorizon.futures; ++i) {
    ends.push_back(futures.path(static_cast<std::size_t>(i)).poses.back().center);
    spread.mean += ends.back() / kHorizon.futures;
  }
  for (const Point2& end : ends) {
    spread.sigma += (end - spread.mean).squaredNorm() / kHorizon.futures;
  }
  spread.sigma = std::sqrt(spread.sigma);
  return spread;
}

TEST(RandomDraws, AreStandardNormalAndUniform) {
  double sum = 0.0;
  double squares = 0.0;
  double uniforms = 0.0;
  constexpr int kCount = 20000;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double normal = kDraws.normal({3, i, 2, 1});
    sum += normal;
    squares += normal * normal;
    uniforms += kDraws.uniform({3, i, 2, 1});
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.03);
  EXPECT_NEAR(squares / kCount, 1.0, 0.04);
  EXPECT_NEAR(uniforms / kCount, 0.5, 0.01);
}

TEST(RandomDraws, OfOneKeyAreTheSame) {
  const RandomDraws again(1);
  const RandomDraws other(2);
  EXPECT_EQ(kDraws.normal({5, 6, 7, 8}), again.normal({5, 6, 7, 8}));
  EXPECT_NE(kDraws.normal({5, 6, 7, 8}), other.normal({5, 6, 7, 8}));
}

TEST(ObjectFutures, KeepTheirVelocityOnAverage) {
  const Track track = knownTrack(1, {5, 2}, {10, 0});
  const ObjectFutureOptions options = withoutSwitching();
  const Spread spread = endsOf(ObjectFutures(track, std::nullopt, options, kHorizon, kDraws));
  EXPECT_NEAR(spread.mean.x(), 45.0, 0.6);
  EXPECT_NEAR(spread.mean.y(), 2.0, 0.6);
}

TEST(ObjectFutures, SpreadWithTheCovariance) {
  Track track = knownTrack(1, {0, 0}, {10, 0});
  const ObjectFutureOptions options = withoutSwitching();
  const double known = endsOf(ObjectFutures(track, std::nullopt, options, kHorizon, kDraws)).sigma;
  track.covariance(3, 3) = 4.0;  // 2 m/s to the side, 8 m after 4 s
  const double uncertain =
      endsOf(ObjectFutures(track, std::nullopt, options, kHorizon, kDraws)).sigma;
  EXPECT_NEAR(std::sqrt(uncertain * uncertain - known * known), 8.0, 1.2);
}

TEST(ObjectFutures, WhatStandsStays) {
  const Track track = knownTrack(1, {5, 2}, {0, 0});
  const ObjectFutureOptions options = withoutSwitching();
  const Spread spread = endsOf(ObjectFutures(track, std::nullopt, options, kHorizon, kDraws));
  EXPECT_NEAR(spread.mean.x(), 5.0, 0.01);
  EXPECT_LT(spread.sigma, 0.05);
}

TEST(ObjectFutures, WhatBrakesComesToRest) {
  Track track = knownTrack(1, {0, 0}, {6, 0});
  track.mode_probabilities = {0.0, 1.0, 0.0, 0.0, 0.0};
  track.state[4] = -3.0;
  const ObjectFutureOptions options = withoutSwitching();
  const ObjectFutures futures(track, std::nullopt, options, kHorizon, kDraws);
  // v^2 / (2 a).
  EXPECT_NEAR(futures.nominalPath().poses.back().center.x(), 6.0, 0.1);
  EXPECT_NEAR(endsOf(futures).mean.x(), 6.0, 0.4);
}

TEST(ObjectFutures, TurnToTheSideOfTheMode) {
  Track track = knownTrack(1, {0, 0}, {5, 0});
  track.mode_probabilities = {0.0, 0.0, 1.0, 0.0, 0.0};
  const ObjectFutureOptions options = withoutSwitching();
  const BodyPath path = ObjectFutures(track, std::nullopt, options, kHorizon, kDraws).nominalPath();
  const double rate = options.motion.motion.turn_rate;
  EXPECT_NEAR(path.poses.back().heading, 4.0 * rate, 1e-9);
  EXPECT_GT(path.poses.back().center.y(), 5.0);
}

TEST(ObjectFutures, PedestriansTurnMoreFreely) {
  const Track car = knownTrack(1, {0, 0}, {1.5, 0});
  const Track pedestrian = knownTrack(1, {0, 0}, {1.5, 0}, ObjectClass::kPedestrian);
  const ObjectFutureOptions options = withoutSwitching();
  EXPECT_GT(endsOf(ObjectFutures(pedestrian, std::nullopt, options, kHorizon, kDraws)).sigma,
            1.2 * endsOf(ObjectFutures(car, std::nullopt, options, kHorizon, kDraws)).sigma);
}

TEST(ObjectFutures, WhoDrivesComesBackToHisCourse) {
  const Track car = knownTrack(1, {0, 0}, {14, 0});
  ObjectFutureOptions options = withoutSwitching();
  options.motion.motion.acceleration_density = 1e-6;
  const double back = endsOf(ObjectFutures(car, std::nullopt, options, kHorizon, kDraws)).sigma;
  options.turning_time = 100.0;
  // A random walk of the course: v s sqrt(t^3 / 3).
  const double walk = endsOf(ObjectFutures(car, std::nullopt, options, kHorizon, kDraws)).sigma;
  EXPECT_NEAR(walk, 14.0 * options.vehicle_turning * std::sqrt(64.0 / 3.0), 0.35);
  EXPECT_LT(back, 0.75 * walk);
}

TEST(ObjectFutures, SwitchingModesSpreadThem) {
  const Track track = knownTrack(1, {0, 0}, {10, 0});
  const ObjectFutureOptions kept = withoutSwitching();
  const ObjectFutureOptions switching;
  EXPECT_GT(endsOf(ObjectFutures(track, std::nullopt, switching, kHorizon, kDraws)).sigma,
            1.5 * endsOf(ObjectFutures(track, std::nullopt, kept, kHorizon, kDraws)).sigma);
}

TEST(HorizonOptions, AStepThatDoesNotDivideTheHorizonReachesBeyondIt) {
  HorizonOptions options;
  EXPECT_EQ(options.steps(), 20U);
  options.step = 0.3;
  EXPECT_EQ(options.steps(), 14U);
}

/// An oncoming car in its lane whose velocity is little known, and seems to lead across the road.
Track vagueOncoming(double across) {
  Track track = knownTrack(1, {40, 3.5}, {-10.0, -across});
  track.covariance.diagonal() << 1.0, 0.25, 1.0, 1.0, 1e-4, 1e-4;
  track.heading_variance = 0.04;
  return track;
}

/// rad; the road is along x.
constexpr double kRoad = 0.0;

/// Turns among the modes of an object of which nothing is known.
constexpr double kTurnShare = 0.2;

std::optional<RoadFollower> followerOf(const Track& track) {
  return roadFollower(track, startOf(track, 0.3), kRoad, kTurnShare, RoadFollowingOptions());
}

TEST(RoadFollower, WhoSeemsToLeaveTheRoadALittleProbablyDoesNot) {
  const Track track = vagueOncoming(1.5);
  const auto follower = followerOf(track);
  ASSERT_TRUE(follower);
  EXPECT_GT(follower->probability, 0.9);
  // Kalman: of 1.5 m/s with a variance of 1, and (0.05 10.1)^2 of the road's.
  const double variance = std::pow(0.05 * std::hypot(10.0, 1.5), 2);
  EXPECT_NEAR(follower->start.state[3], -1.5 * variance / (1.0 + variance), 1e-9);
  EXPECT_EQ(follower->start.state[2], -10.0);
  // The box's heading has a standard deviation of 0.2 rad: its share of the way to the road is
  // 0.04 / (0.04 + 0.0025), whose other end it points to.
  const double share = 0.04 / 0.0425;
  const double off = angleBetween(kPi, track.box.center.heading());
  EXPECT_NEAR(angleBetween(kPi, follower->start.heading), (1.0 - share) * off, 1e-9);
  EXPECT_NEAR(follower->start.heading_sigma, 0.2 * std::sqrt(1.0 - share), 1e-9);
}

TEST(RoadFollower, WhoLeavesItForSureDoes) {
  Track track = vagueOncoming(4.0);
  track.covariance(3, 3) = 0.04;
  const auto follower = followerOf(track);
  ASSERT_TRUE(follower);
  EXPECT_LT(follower->probability, 1e-6);
}

TEST(RoadFollower, PedestriansAndWhoStandsHaveNoRoad) {
  const Track walks = knownTrack(1, {20, 3}, {-1.2, 0}, ObjectClass::kPedestrian);
  EXPECT_FALSE(followerOf(walks));
  const Track stands = knownTrack(2, {20, 3}, {0, 0});
  EXPECT_FALSE(followerOf(stands));
}

TEST(RoadFollower, WhatMayBeAnythingFollowsItLessProbably) {
  Track track = vagueOncoming(1.5);
  const double driver = followerOf(track)->probability;
  track.class_probabilities.fill(1.0);  // each a share of 1: more than all
  EXPECT_LE(followerOf(track)->probability, 1.0);
  track.class_probabilities.fill(0.2);
  EXPECT_LT(followerOf(track)->probability, driver);
}

// Bayes: that the track turns is as likely by the wrong velocity as by a turn; the odds change by
// no more than the modes' own evidence.
TEST(RoadFollower, ModesOfATurnAreEvidenceAndNoProof) {
  Track track = vagueOncoming(1.5);
  const double straight = followerOf(track)->probability;
  track.mode_probabilities = {0.3, 0.0, 0.7, 0.0, 0.0};
  const double turns = followerOf(track)->probability;
  EXPECT_GT(turns, 0.8);
  EXPECT_NEAR(turns / (1.0 - turns), 0.3 * straight / (1.0 - straight), 1e-9);
}

TEST(RoadFollower, ModesThatAreNotKnownAreNoEvidence) {
  Track track = vagueOncoming(1.5);
  track.mode_probabilities = {1.0 - kTurnShare, 0.0, kTurnShare, 0.0, 0.0};  // as of any object
  const double usual = followerOf(track)->probability;
  track.mode_probabilities.fill(0.0);
  EXPECT_NEAR(followerOf(track)->probability, usual, 1e-12);
}

TEST(ObjectFutures, AlongTheRoadDoNotTurnOffLater) {
  const Track car = knownTrack(1, {40, 3.5}, {-10, 0});
  ObjectFutureOptions options;
  options.road_following.probability = 0.999;
  const double free = endsOf(ObjectFutures(car, std::nullopt, options, kHorizon, kDraws)).sigma;
  EXPECT_LT(endsOf(ObjectFutures(car, kRoad, options, kHorizon, kDraws)).sigma, 0.8 * free);
}

TEST(ObjectFutures, WhoTurnsDoesNotFollowTheRoad) {
  Track track = vagueOncoming(0.0);
  track.mode_probabilities = {0.0, 0.0, 1.0, 0.0, 0.0};
  const ObjectFutureOptions options = withoutSwitching();
  const double free =
      endsOf(ObjectFutures(track, std::nullopt, options, kHorizon, kDraws)).mean.y();
  const double beside = endsOf(ObjectFutures(track, kRoad, options, kHorizon, kDraws)).mean.y();
  EXPECT_LT(free, -5.0) << "it turns left, toward the host's lane";
  EXPECT_EQ(free, beside);
}

TEST(ObjectFutures, AlongTheRoadStayInTheirLane) {
  const Track track = vagueOncoming(1.5);
  const ObjectFutureOptions options = withoutSwitching();
  const double free =
      endsOf(ObjectFutures(track, std::nullopt, options, kHorizon, kDraws)).mean.y();
  const double along = endsOf(ObjectFutures(track, kRoad, options, kHorizon, kDraws)).mean.y();
  EXPECT_LT(free, -2.0);
  EXPECT_NEAR(along, 3.5, 1.5);
}

}  // namespace
}  // namespace datmo::object_futures_test
