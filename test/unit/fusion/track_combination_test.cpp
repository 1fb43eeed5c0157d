// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_combination.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "fusion_tracks.h"
#include <gtest/gtest.h>

namespace datmo::track_combination_test {
namespace {

CrossCovariance none(std::size_t /*a*/, std::size_t /*b*/) { return CrossCovariance::Zero(); }

Track combined(const std::vector<Track>& tracks, bool contradict = false) {
  return datmo::combined(tracks, contradict, none, TrackCombinationOptions());
}

Track lidarCar() { return carTrack(10.0, 2.0, 5.0, 0.0, "lidar", 3); }
Track stereoCar() { return carTrack(10.4, 2.2, 5.2, 0.0, "stereo", 8); }

void turnTo(Track& track, double heading) {
  track.box.center = Pose2(track.box.center.position(), heading);
}

double fusedHeading(const Track& a, const Track& b) {
  const double heading = combined({a, b}).box.center.heading();
  const double other = combined({b, a}).box.center.heading();
  EXPECT_NEAR(std::cos(heading - other), 1.0, 1e-9) << heading << " or " << other;
  return heading;
}

TEST(TrackCombinationTest, TheStateIsFusedAndTheBoxFollowsIt) {
  const Track fused = combined({lidarCar(), stereoCar()});
  EXPECT_NEAR(fused.state[0], 10.2, 1e-9);
  EXPECT_NEAR(fused.state[2], 5.1, 1e-9);
  EXPECT_NEAR((fused.box.center.position() - fused.state.head<2>()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(fused.covariance(0, 0), 0.04, 1e-9);
}

TEST(TrackCombinationTest, OfTwoThatContradictEachOtherTheCovarianceCoversBoth) {
  Track stands = stereoCar();
  stands.state.segment<2>(2).setZero();
  const Track fused = combined({lidarCar(), stands}, true);
  EXPECT_NEAR(fused.state[2], 2.5, 1e-9);
  EXPECT_GT(fused.covariance(2, 2), 2.5 * 2.5);
  EXPECT_NEAR((fused.box.center.position() - fused.state.head<2>()).norm(), 0.0, 1e-12);
}

TEST(TrackCombinationTest, HeadingsAreFusedByTheirVariances) {
  const Track a = lidarCar();
  Track b = stereoCar();
  turnTo(b, 0.2);
  EXPECT_NEAR(fusedHeading(a, b), 0.1, 1e-9);
  // No more certain than one of them: both track the same motion.
  EXPECT_NEAR(combined({a, b}).heading_variance, 0.01, 1e-9);
  // Weights 3/4 and 1/4 of the informations 100 and 100/3: 75 and 8.33.
  b.heading_variance = 0.03;
  EXPECT_NEAR(fusedHeading(a, b), 0.02, 1e-9);
  EXPECT_NEAR(combined({a, b}).heading_variance, 0.012, 1e-9);
}

TEST(TrackCombinationTest, OfContradictoryHeadingsTheMoreCertainOneIsKept) {
  const Track a = lidarCar();
  Track b = stereoCar();
  b.heading_variance = 0.02;
  turnTo(b, 1.0);
  EXPECT_NEAR(fusedHeading(a, b), 0.0, 1e-9);
  b.heading_variance = 0.005;
  EXPECT_NEAR(fusedHeading(a, b), 1.0, 1e-9);
}

TEST(TrackCombinationTest, TheFrontIsInTheDirectionOfMotion) {
  Track a = lidarCar();
  Track b = stereoCar();
  turnTo(b, kPi);
  EXPECT_NEAR(std::cos(fusedHeading(a, b)), 1.0, 1e-9);  // of both by the velocity
  a.moving = false;
  EXPECT_NEAR(std::cos(fusedHeading(a, b)), -1.0, 1e-9);  // of the one that moves
  b.moving = false;
  a.state.segment<2>(2).setZero();
  b.state.segment<2>(2).setZero();
  b.heading_variance = 0.005;
  EXPECT_NEAR(std::cos(fusedHeading(a, b)), -1.0, 1e-9);  // of the surer one
}

TEST(TrackCombinationTest, TheSizeIsThatOfTheMoreCertainCenter) {
  // The lidar sees the rear: it knows the width, but not where the center is along the car.
  Track a = lidarCar();
  a.box.length = 3.0;
  a.covariance(0, 0) = 1.0;
  a.covariance(1, 1) = 0.01;
  Track b = stereoCar();
  b.box.length = 5.0;
  b.box.width = 2.8;
  b.covariance(0, 0) = 0.25;
  b.covariance(1, 1) = 0.09;
  const Box2 box = combined({a, b}).box;
  EXPECT_NEAR(box.length, (3.0 * 0.25 + 5.0 * 1.0) / 1.25, 1e-9);
  EXPECT_NEAR(box.width, (1.8 * 0.09 + 2.8 * 0.01) / 0.10, 1e-9);
}

TEST(TrackCombinationTest, SizesAreThoseAlongTheCommonAxes) {
  // The more certain one takes the width for the length.
  Track a = lidarCar();
  a.box.length = 1.8;
  a.box.width = 4.5;
  turnTo(a, kQuarterTurn);
  a.heading_variance = 0.005;
  const Box2 box = combined({a, stereoCar()}).box;
  EXPECT_NEAR(box.center.heading(), kQuarterTurn, 1e-9);
  EXPECT_NEAR(box.length, 1.8, 1e-9);
  EXPECT_NEAR(box.width, 4.5, 1e-9);
}

TEST(TrackCombinationTest, ClassesAreFusedByBayes) {
  Track a = lidarCar();
  Track b = stereoCar();
  // Of even odds of 1: 4 and 1: 2, the others never above.
  a.class_probabilities = {0.1, 0.1, 0.4, 0.3, 0.1};
  b.class_probabilities = {0.1, 0.1, 0.1, 0.6, 0.1};
  const Track fused = combined({a, b});
  // Products 0.01, 0.01, 0.04, 0.18, 0.01 of 0.25; 0.95 of them, and 0.01.
  EXPECT_NEAR(fused.class_probabilities[3], 0.95 * 0.72 + 0.01, 1e-9);
  EXPECT_NEAR(fused.class_probabilities[2], 0.95 * 0.16 + 0.01, 1e-9);
  b.class_probabilities = {};  // a source without classes takes nothing from the others
  EXPECT_NEAR(combined({a, b}).class_probabilities[3], 0.95 * 0.3 + 0.01, 1e-9);
}

TEST(TrackCombinationTest, TheMotionModesAreAveraged) {
  Track a = lidarCar();
  Track b = stereoCar();
  a.mode_probabilities = {1.0, 0.0, 0.0, 0.0, 0.0};
  b.mode_probabilities = {0.5, 0.0, 0.5, 0.0, 0.0};
  b.yaw_rate = 0.2;
  const Track fused = combined({a, b});
  EXPECT_NEAR(fused.mode_probabilities[0], 0.75, 1e-12);
  EXPECT_NEAR(fused.mode_probabilities[2], 0.25, 1e-12);
  EXPECT_NEAR(fused.yaw_rate, 0.1, 1e-12);
  b.mode_probabilities = {};
  EXPECT_EQ(combined({a, b}).mode_probabilities, a.mode_probabilities);
}

TEST(TrackCombinationTest, TheRestOfBothIsKept) {
  Track a = lidarCar();
  Track b = stereoCar();
  a.sources = {{"lidar", 3}, {"radar", 5}};
  b.sources = {{"stereo", 8}, {"lidar", 3}};
  a.sensors = {"stereo", "lidar"};
  a.moving = false;
  b.height = 1.5;
  a.since_update = 0.3;
  a.hits = std::numeric_limits<std::uint32_t>::max() - 5;
  const Track fused = combined({a, b});
  EXPECT_EQ(fused.sensors, (std::vector<std::string>{"lidar", "stereo"}));
  ASSERT_EQ(fused.sources.size(), 3U);
  EXPECT_EQ(fused.sources[0].source, "lidar");
  EXPECT_EQ(fused.sources[1].id, 5U);
  EXPECT_EQ(fused.sources[2].source, "stereo");
  EXPECT_TRUE(fused.moving);
  EXPECT_EQ(fused.height, 1.5);
  EXPECT_EQ(fused.since_update, 0.0);
  EXPECT_EQ(fused.hits, std::numeric_limits<std::uint32_t>::max());
  EXPECT_TRUE(fused.objects.empty());
}

TEST(TrackCombinationTest, IdExistenceAgeAndHistoryAreThoseOfTheFirst) {
  Track a = lidarCar();
  Track b = stereoCar();
  a.history = {{Stamp{1}, Pose2()}};
  b.existence_probability = 0.1;
  b.age = 9.0;
  const Track fused = combined({a, b});
  EXPECT_EQ(fused.id, a.id);
  EXPECT_EQ(fused.existence_probability, a.existence_probability);
  EXPECT_EQ(fused.age, a.age);
  EXPECT_EQ(fused.history.size(), 1U);
}

TEST(TrackCombinationTest, OfThreeEachCountsAsMuchAsTheOthers) {
  Track turning = carTrack(10.2, 1.9, 5.1, 0.0, "radar", 4);
  turning.yaw_rate = 0.3;
  turning.mode_probabilities = {0.0, 0.0, 1.0, 0.0, 0.0};
  turning.box.length = 6.0;
  turnTo(turning, 0.15);
  Track other = stereoCar();
  other.moving = false;
  turnTo(other, kPi);
  for (const std::vector<Track>& tracks :
       {std::vector<Track>{lidarCar(), other, turning}, {turning, lidarCar(), other}}) {
    const Track whole = combined(tracks);
    EXPECT_NEAR(whole.yaw_rate, 0.1, 1e-12);
    EXPECT_NEAR(whole.mode_probabilities[2], (0.03 + 0.03 + 1.0) / 3.0, 1e-12);
    EXPECT_NEAR(whole.box.length, (4.5 + 4.5 + 6.0) / 3.0, 1e-2);
    EXPECT_NEAR(whole.box.center.heading(), 0.05, 1e-9);
    EXPECT_EQ(whole.sources.size(), 3U);
    EXPECT_EQ(whole.hits, 60U);
  }
}

TEST(TrackCombinationTest, OfThreeHeadingsTheOneThatContradictsTheBestIsIgnored) {
  Track surest = lidarCar();
  surest.heading_variance = 0.005;
  Track near = stereoCar();
  turnTo(near, 0.09);
  Track off = stereoCar();
  turnTo(off, 1.0);
  // Weights 2/3 and 1/3 of the informations 200 and 100: 133 and 33.
  EXPECT_NEAR(combined({off, near, surest}).box.center.heading(), 0.09 * 0.2, 1e-9);
}

TEST(TrackCombinationTest, OrderDoesNotMatterNorDoTheAxesOfTheMap) {
  Random random(5);
  const double angle = 2.0;
  const TrackCovariance turn = stateRotation(angle);
  const auto turned = [&](Track track) {
    track.state = turn * track.state;
    track.covariance = turn * track.covariance * turn.transpose();
    track.box.center = Pose2(0.0, 0.0, angle) * track.box.center;
    return track;
  };
  for (int i = 0; i < 200; ++i) {
    std::vector<Track> tracks = {lidarCar(), stereoCar()};
    for (Track& track : tracks) {
      track.covariance = randomCovariance(random);
      track.heading_variance = random.uniform(0.001, 0.5);
      track.moving = random.chance(0.7);
      track.box.length = random.uniform(1.0, 6.0);
      turnTo(track, random.uniform(-kPi, kPi));
    }
    const Track one = combined({tracks[0], tracks[1]});
    const Track swapped = combined({tracks[1], tracks[0]});
    const Track other = combined({turned(tracks[0]), turned(tracks[1])});
    for (const auto& [expected, actual] :
         {std::pair(one, swapped), std::pair(turned(one), other)}) {
      EXPECT_TRUE(actual.state.isApprox(expected.state, 1e-6));
      EXPECT_TRUE(actual.covariance.isApprox(expected.covariance, 1e-6));
      EXPECT_NEAR(std::cos(actual.box.center.heading() - expected.box.center.heading()), 1.0, 1e-9);
      EXPECT_NEAR(actual.heading_variance, expected.heading_variance, 1e-9);
      EXPECT_NEAR(actual.box.length, expected.box.length, 1e-6);
      EXPECT_NEAR(actual.box.width, expected.box.width, 1e-6);
    }
  }
}

}  // namespace
}  // namespace datmo::track_combination_test
