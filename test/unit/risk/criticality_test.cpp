// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/criticality.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace datmo::criticality_test {
namespace {

constexpr BodySize kCar{2.0, 1.0};
constexpr double kStep = 0.1;
constexpr double kHorizon = 5.0;

/// A body that moves straight along its velocity.
BodyPath straight(const Point2& start, const Point2& velocity) {
  BodyPath path{kStep, {}};
  const double heading = velocity.norm() > 0.0 ? std::atan2(velocity.y(), velocity.x()) : 0.0;
  for (int i = 0; i * kStep <= kHorizon + 1e-9; ++i) {
    path.poses.push_back(bodyPose(start + i * kStep * velocity, heading));
  }
  return path;
}

TEST(Braked, StopsAfterItsBrakingDistance) {
  const BodyPath path = braked(straight({0, 0}, {10, 0}), 1.0, 5.0);
  // 10 m until it brakes, and 10^2 / (2 * 5) of braking distance.
  EXPECT_NEAR(path.poses.back().center.x(), 20.0, 1e-9);
  EXPECT_NEAR(path.poses[5].center.x(), 5.0, 1e-9);
}

TEST(Braked, WithoutDecelerationContinues) {
  const BodyPath path = braked(straight({0, 0}, {10, 0}), 0.0, 0.0);
  EXPECT_NEAR(path.poses.back().center.x(), 50.0, 1e-9);
}

TEST(TimeToBrake, EndsWhereTheBrakingDistanceBegins) {
  const BodyPath host = straight({0, 0}, {10, 0});
  const BodyPath wall = straight({34, 0}, {0, 0});
  const Encounter encounter{host, kCar, wall, kCar};
  // A gap of 30 m, of which 10^2 / (2 * 5) are braking distance: 20 m at 10 m/s.
  EXPECT_NEAR(timeToBrake(encounter, 5.0), 2.0, 0.06);
  EXPECT_NEAR(brakeThreat(encounter, 5.0), 100.0 / 60.0 / 5.0, 0.07);
}

TEST(TimeToBrake, IsZeroIfItIsTooLate) {
  const BodyPath host = straight({0, 0}, {10, 0});
  const BodyPath wall = straight({10, 0}, {0, 0});
  const Encounter encounter{host, kCar, wall, kCar};
  EXPECT_EQ(timeToBrake(encounter, 5.0), 0.0);
  EXPECT_GT(brakeThreat(encounter, 5.0), 1.0);
}

TEST(TimeToBrake, IsTheHorizonWithoutContact) {
  const BodyPath host = straight({0, 0}, {10, 0});
  const BodyPath aside = straight({20, 5}, {0, 0});
  const Encounter encounter{host, kCar, aside, kCar};
  EXPECT_NEAR(timeToBrake(encounter, 5.0), kHorizon, 1e-9);
  EXPECT_EQ(brakeThreat(encounter, 5.0), 0.0);
  EXPECT_EQ(steerThreat(encounter, 5.0), 0.0);
}

TEST(BrakeThreat, IsImpossibleWhenStruckFromBehind) {
  const BodyPath host = straight({0, 0}, {5, 0});
  const BodyPath follower = straight({-15, 0}, {15, 0});
  const Encounter encounter{host, kCar, follower, kCar};
  EXPECT_EQ(brakeThreat(encounter, 6.0), kHopeless);
  EXPECT_EQ(timeToBrake(encounter, 6.0), 0.0);
}

TEST(Steered, TurnsIntoTheDirectionOfMotion) {
  const BodyPath ahead = steered(straight({0, 0}, {2, 0}), 5.0);
  EXPECT_NEAR(ahead.poses[10].heading, std::atan2(5.0, 2.0), 1e-9);
  BodyPath backward = straight({0, 0}, {-2, 0});
  for (BodyPose& pose : backward.poses) {
    pose = bodyPose(pose.center, 0.0);
  }
  const BodyPath evading = steered(backward, 5.0);
  EXPECT_GT(evading.poses[10].center.y(), 0.0) << "to its left";
  EXPECT_NEAR(evading.poses[10].heading, -std::atan2(5.0, 2.0), 1e-9) << "its rear goes ahead";
}

TEST(SteerThreat, IsLessToTheNearerSide) {
  const BodyPath host = straight({0, 0}, {10, 0});
  const BodyPath left_of_middle = straight({24, 1.0}, {0, 0});
  const BodyPath middle = straight({24, 0.0}, {0, 0});
  const double aside = steerThreat({host, kCar, left_of_middle, kCar}, 5.0);
  const double straight_ahead = steerThreat({host, kCar, middle, kCar}, 5.0);
  EXPECT_LT(aside, straight_ahead);
  // 2 m to the side within 2 s, and a little for the turned box: y = a t^2 / 2.
  EXPECT_NEAR(straight_ahead, 1.0 / 5.0, 0.15);
}

TEST(PostEncroachmentTime, IsTheGapInTimeOfCrossingPaths) {
  const BodyPath host = straight({-20, 0}, {10, 0});
  // The host's rear leaves the strip |x| <= 1, |y| <= 1 at 2.3 s; the other's front reaches it
  // after (12 - 3) / 3 s.
  const BodyPath other = straight({0, -12}, {0, 3});
  EXPECT_NEAR(postEncroachmentTime({host, kCar, other, kCar}), 0.7, 0.11);
}

TEST(PostEncroachmentTime, IsZeroOfContactAndInfiniteOfPathsApart) {
  const BodyPath host = straight({-20, 0}, {10, 0});
  const BodyPath crossing = straight({0, -20}, {0, 10});
  EXPECT_EQ(postEncroachmentTime({host, kCar, crossing, kCar}), 0.0);
  const BodyPath apart = straight({-20, 4}, {10, 0});
  EXPECT_EQ(postEncroachmentTime({host, kCar, apart, kCar}),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace datmo::criticality_test
