// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/object_start.h"

#include <cmath>
#include <optional>

#include "risk/risk_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::object_start_test {
namespace {

/// rad; the road is along x.
constexpr double kRoad = 0.0;

/// Share of turns among the modes of an object about which nothing is known.
constexpr double kTurnShare = 0.2;

std::optional<RoadFollower> followerOf(const Track& track) {
  return roadFollower(track, startOf(track, 0.3), kRoad, kTurnShare, RoadFollowingOptions());
}

TEST(RoadFollower, ASlightDepartureFromTheRoadIsProbablyNoise) {
  const Track track = vagueOncoming(1.5);
  const auto follower = followerOf(track);
  ASSERT_TRUE(follower);
  EXPECT_GT(follower->probability, 0.9);
  // Kalman: of 1.5 m/s with a variance of 1, and (0.05 * 10.1)^2 of the road's.
  const double variance = std::pow(0.05 * std::hypot(10.0, 1.5), 2);
  EXPECT_NEAR(follower->start.state[3], -1.5 * variance / (1.0 + variance), 1e-9);
  EXPECT_EQ(follower->start.state[2], -10.0);
  // The box's heading has a standard deviation of 0.2 rad: it is corrected by the share 0.04 /
  // (0.04 + 0.0025) toward the road, in whose other direction (pi) it points.
  const double share = 0.04 / 0.0425;
  const double off = angleBetween(kPi, track.box.center.heading());
  EXPECT_NEAR(angleBetween(kPi, follower->start.heading), (1.0 - share) * off, 1e-9);
  EXPECT_NEAR(follower->start.heading_sigma, 0.2 * std::sqrt(1.0 - share), 1e-9);
}

TEST(RoadFollower, AClearDepartureIsReal) {
  Track track = vagueOncoming(4.0);
  track.covariance(3, 3) = 0.04;
  const auto follower = followerOf(track);
  ASSERT_TRUE(follower);
  EXPECT_LT(follower->probability, 1e-6);
}

TEST(RoadFollower, PedestriansAndStationaryObjectsHaveNoRoad) {
  const Track walks = knownTrack(1, {20, 3}, {-1.2, 0}, ObjectClass::kPedestrian);
  EXPECT_FALSE(followerOf(walks));
  const Track stands = knownTrack(2, {20, 3}, {0, 0});
  EXPECT_FALSE(followerOf(stands));
}

TEST(RoadFollower, AnUnknownClassFollowsItLessProbably) {
  Track track = vagueOncoming(1.5);
  const double driver = followerOf(track)->probability;
  track.class_probabilities.fill(1.0);  // each a share of 1: more than all
  EXPECT_LE(followerOf(track)->probability, 1.0);
  track.class_probabilities.fill(0.2);
  EXPECT_LT(followerOf(track)->probability, driver);
}

// Bayes: the track's turn is as likely due to a wrong velocity as to an actual turn; the odds
// change by no more than the modes' own evidence.
TEST(RoadFollower, ModesOfATurnAreEvidenceAndNoProof) {
  Track track = vagueOncoming(1.5);
  const double straight = followerOf(track)->probability;
  track.mode_probabilities = {0.3, 0.0, 0.7, 0.0, 0.0};
  const double turns = followerOf(track)->probability;
  EXPECT_GT(turns, 0.8);
  EXPECT_NEAR(turns / (1.0 - turns), 0.3 * straight / (1.0 - straight), 1e-9);
}

TEST(RoadFollower, UnknownModesAreNoEvidence) {
  Track track = vagueOncoming(1.5);
  track.mode_probabilities = {1.0 - kTurnShare, 0.0, kTurnShare, 0.0, 0.0};  // as of any object
  const double usual = followerOf(track)->probability;
  track.mode_probabilities.fill(0.0);
  EXPECT_NEAR(followerOf(track)->probability, usual, 1e-12);
}

// A moving object is no pole, and one of any moving class drives as often as one of a known class.
TEST(RoadFollower, AnUnknownClassAndAPoleAreNoEvidenceAgainstADriver) {
  Track track = vagueOncoming(1.5);
  const double driver = followerOf(track)->probability;
  track.class_probabilities = {0.2, 0.0, 0.0, 0.6, 0.2};
  EXPECT_NEAR(followerOf(track)->probability, driver, 1e-12);
}

TEST(RoadFollower, ObjectsAlmostAlongTheRoadThatTurnTowardItJoin) {
  EXPECT_GT(followerOf(joiningCar(0.45))->joining, 0.6);
  Track leaves = joiningCar(0.45);
  leaves.mode_probabilities = {0.4, 0.4, 0.18, 0.02, 0.0};
  EXPECT_LT(followerOf(leaves)->joining, 0.2);
}

TEST(RoadFollower, ObjectsThatCrossItStraightDoNotJoin) {
  Track crosses = joiningCar(1.5);
  crosses.mode_probabilities = {0.96, 0.0, 0.02, 0.02, 0.0};
  EXPECT_LT(followerOf(crosses)->joining, 0.15);
}

TEST(TurnIntoRoad, IsTheNearerDirection) {
  EXPECT_NEAR(turnIntoRoad(0.3, 0.0), -0.3, 1e-12);
  EXPECT_NEAR(turnIntoRoad(kPi - 0.3, 0.0), 0.3, 1e-12);
  EXPECT_NEAR(turnIntoRoad(-kPi + 0.3, 0.0), -0.3, 1e-12);
}

}  // namespace
}  // namespace datmo::object_start_test
