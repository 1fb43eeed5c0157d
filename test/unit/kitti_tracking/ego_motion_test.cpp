// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/ego_motion.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/random.h"

namespace datmo::kitti::ego_motion_test {
namespace {

constexpr double kPeriod = 0.1;  // s
const Eigen::Matrix2d kCovariance = 0.01 * Eigen::Matrix2d::Identity();

/// Parked cars every 6 m on both sides of a road.
std::vector<Point2> parkedCars() {
  std::vector<Point2> cars;
  for (int i = 0; i < 30; ++i) {
    cars.emplace_back(6.0 * i, 5.0);
    cars.emplace_back(6.0 * i + 2.0, -6.0);
  }
  return cars;
}

std::vector<Landmark> landmarksAt(const std::vector<Point2>& positions) {
  std::vector<Landmark> landmarks;
  for (const Point2& position : positions) {
    landmarks.push_back({position, kCovariance});
  }
  return landmarks;
}

/// Those within 40 m ahead, in the vehicle's frame.
std::vector<Landmark> seenFrom(const Pose2& base, const std::vector<Point2>& positions) {
  std::vector<Landmark> seen;
  for (const Point2& position : positions) {
    const Point2 local = base.inverse() * position;
    if (local.x() > 0.0 && local.norm() < 40.0) {
      seen.push_back({local, kCovariance});
    }
  }
  return seen;
}

/// Drives on; what was seen in a frame is expected in the next one, where it was found.
class Drive {
 public:
  explicit Drive(const EgoMotionOptions& options = {}) : ego(options) {}

  void frame(const Twist2& twist, const std::vector<Point2>& positions) {
    truth = truth * arc(twist, kPeriod);
    const std::vector<Landmark> seen = seenFrom(truth, positions);
    ego.step(kPeriod, expected_, seen);
    expected_.clear();
    for (const Landmark& landmark : seen) {
      expected_.push_back({ego.baseInFixed() * landmark.position, kCovariance});
    }
  }

  EgoMotion ego;
  Pose2 truth;

 private:
  std::vector<Landmark> expected_;
};

TEST(EgoMotionTest, FindsSpeedAndYawRateFromParkedCars) {
  const Twist2 twist{8.0, 0.1};
  Drive drive;
  for (int i = 0; i < 40; ++i) {
    drive.frame(twist, parkedCars());
  }
  EXPECT_NEAR(drive.ego.twist().forward_speed, 8.0, 0.05);
  EXPECT_NEAR(drive.ego.twist().yaw_rate, 0.1, 0.005);
  // There is no information about the first step, and little about the turn rate in the second one.
  const Pose2 distance = drive.ego.baseInFixed();
  EXPECT_NEAR(std::abs(angleBetween(distance.heading(), drive.truth.heading())), 0.0, 0.05);
  EXPECT_NEAR(distance.position().norm(), drive.truth.position().norm(), 1.5);
}

TEST(EgoMotionTest, FindsAnySpeedAtTheSecondFrame) {
  for (const double speed : {0.0, 5.0, 14.0, 22.0}) {
    Drive drive;
    drive.frame({speed, 0.0}, {Point2(20.0, 4.0), Point2(33.0, -5.0), Point2(41.0, 6.0)});
    drive.frame({speed, 0.0}, {Point2(20.0, 4.0), Point2(33.0, -5.0), Point2(41.0, 6.0)});
    EXPECT_NEAR(drive.ego.twist().forward_speed, speed, 0.3) << speed;
  }
}

TEST(EgoMotionTest, FollowsBraking) {
  Drive drive;
  double speed = 10.0;
  for (int i = 0; i < 40; ++i) {
    speed -= i > 10 ? 3.0 * kPeriod : 0.0;
    drive.frame({speed, 0.0}, parkedCars());
  }
  EXPECT_NEAR(drive.ego.twist().forward_speed, speed, 0.6);
}

TEST(EgoMotionTest, CarsThatMoveDoNotDecide) {
  const Twist2 twist{10.0, 0.0};
  Drive drive;
  for (int i = 0; i < 40; ++i) {
    std::vector<Point2> positions = parkedCars();
    positions.emplace_back(15.0 + 1.2 * i, 1.5);
    positions.emplace_back(40.0 + 1.4 * i, -2.0);
    positions.emplace_back(180.0 - 1.3 * i, 2.0);
    drive.frame(twist, positions);
  }
  EXPECT_NEAR(drive.ego.twist().forward_speed, 10.0, 0.1);
  EXPECT_NEAR(drive.ego.twist().yaw_rate, 0.0, 0.005);
}

TEST(EgoMotionTest, ContinuesItsMotionWithTooFewMatches) {
  Drive drive;
  for (int i = 0; i < 10; ++i) {
    drive.frame({6.0, 0.0}, parkedCars());
  }
  const Twist2 before = drive.ego.twist();
  const Pose2 pose = drive.ego.baseInFixed();
  const double variance = drive.ego.covariance()(0, 0);
  drive.ego.step(kPeriod, landmarksAt(parkedCars()), {{Point2(500.0, 0.0), kCovariance}});
  EXPECT_EQ(drive.ego.twist().forward_speed, before.forward_speed);
  EXPECT_EQ(drive.ego.twist().yaw_rate, before.yaw_rate);
  EXPECT_GT(drive.ego.covariance()(0, 0), variance);
  EXPECT_NEAR((drive.ego.baseInFixed().position() - pose.position()).norm(),
              kPeriod * before.forward_speed, 1e-9);
}

TEST(EgoMotionTest, NothingSeenIsNoMotion) {
  EgoMotion ego{EgoMotionOptions()};
  for (int i = 0; i < 10; ++i) {
    ego.step(kPeriod, {}, {});
  }
  EXPECT_EQ(ego.baseInFixed().position(), Point2(0.0, 0.0));
  EXPECT_EQ(ego.twist().forward_speed, 0.0);
}

TEST(EgoMotionTest, TheErrorsAreConsistentWithTheCovariance) {
  // NEES of speed and yaw rate over noise of the measurements; the expected positions are exact.
  Random random(7);
  const Eigen::Matrix2d exact = 1e-6 * Eigen::Matrix2d::Identity();
  const std::vector<Point2> positions = parkedCars();
  double sum = 0.0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    EgoMotion ego{EgoMotionOptions()};
    const Pose2 base = arc({7.0, 0.05}, kPeriod);
    std::vector<Landmark> seen = seenFrom(base, positions);
    for (Landmark& landmark : seen) {
      landmark.position += Point2(random.normal(0.1), random.normal(0.1));
    }
    std::vector<Landmark> expected = landmarksAt(positions);
    for (Landmark& landmark : expected) {
      landmark.covariance = exact;
    }
    ego.step(kPeriod, expected, seen);
    const Eigen::Vector2d error(ego.twist().forward_speed - 7.0, ego.twist().yaw_rate - 0.05);
    sum += error.dot(ego.covariance().inverse() * error);
  }
  // Two degrees of freedom; the weights make it slightly conservative.
  EXPECT_LT(sum / kRuns, 2.5);
  EXPECT_GT(sum / kRuns, 0.8);
}

TEST(EgoMotionTest, OptionsOutOfRangeAreRefused) {
  EgoMotionOptions options;
  options.gate = -1.0;
  EXPECT_THROW(EgoMotion{options}, OptionError);
}

}  // namespace
}  // namespace datmo::kitti::ego_motion_test
