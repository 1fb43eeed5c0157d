// SPDX-License-Identifier: BSD-3-Clause
#include "yard.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/slam/grid_slam.h"

namespace datmo::grid_slam_drift_test {
namespace {

/// Drives a gentle curve with odometry, or stands, 10 scans a second.
class Vehicle {
 public:
  SlamResult step(GridSlam& slam, const Twist2& twist) {
    slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds_), twist});
    pose_ = pose_ * arc(twist, 0.1);
    const SlamResult result = slam.process(Yard().scan(pose_, seconds_));
    seconds_ += 0.1;
    return result;
  }

  /// The same without a hit in any of the scans.
  SlamResult blind(GridSlam& slam, const Twist2& twist, int scans) {
    SlamResult result;
    for (int i = 0; i < scans; ++i) {
      slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds_), twist});
      pose_ = pose_ * arc(twist, 0.1);
      Scan scan = Yard().scan(pose_, seconds_);
      scan.rays.clear();
      result = slam.process(scan);
      seconds_ += 0.1;
    }
    return result;
  }

  SlamResult go(GridSlam& slam, const Twist2& twist, int scans) {
    SlamResult result;
    for (int i = 0; i < scans; ++i) {
      result = step(slam, twist);
    }
    return result;
  }

 private:
  Pose2 pose_;
  double seconds_ = 0.0;
};

TEST(GridSlamDriftTest, TheMapDriftsWithTheDistance) {
  GridSlam slam{GridSlamOptions{}};
  Vehicle vehicle;
  EXPECT_TRUE(vehicle.step(slam, {}).drift.isZero());
  const SlamResult half = vehicle.go(slam, {4.0, 0.05}, 30);
  const SlamResult end = vehicle.go(slam, {4.0, 0.05}, 30);
  EXPECT_GT(half.drift(2, 2), 0.0);
  EXPECT_GT(end.drift(2, 2), half.drift(2, 2));
  EXPECT_GT(end.drift(1, 1), 2.0 * half.drift(1, 1)) << "the heading's error leads aside";
  EXPECT_LT(end.drift(2, 2), square(degrees(2.0)));
  const auto local = [](const SlamResult& result) {
    return result.labeled_scan.base_in_map.covariance(2, 2);
  };
  EXPECT_LT(local(end), 2.0 * local(half)) << "in the map as it is nothing grows";
}

TEST(GridSlamDriftTest, AtRestItDoesNot) {
  GridSlam slam{GridSlamOptions{}};
  Vehicle vehicle;
  const SlamResult end = vehicle.go(slam, {4.0, 0.05}, 60);
  const SlamResult rest = vehicle.go(slam, {}, 200);
  EXPECT_NEAR(rest.drift(2, 2), end.drift(2, 2), 0.1 * end.drift(2, 2));
}

TEST(GridSlamDriftTest, WhatWasDrivenWithoutAMatchStaysUncertain) {
  GridSlam slam{GridSlamOptions{}};
  Vehicle vehicle;
  vehicle.go(slam, {4.0, 0.0}, 20);
  const SlamResult before = vehicle.blind(slam, {4.0, 0.0}, 10);
  const SlamResult after = vehicle.go(slam, {4.0, 0.0}, 2);
  ASSERT_TRUE(after.match.accepted);
  const auto sinceStart = [](const SlamResult& result) {
    return result.labeled_scan.base_in_map.covariance(0, 0) + result.drift(0, 0);
  };
  EXPECT_GT(sinceStart(after), 0.9 * sinceStart(before));
}

TEST(GridSlamDriftTest, AResetForgetsIt) {
  GridSlam slam{GridSlamOptions{}};
  Vehicle().go(slam, {4.0, 0.05}, 30);
  slam.reset();
  EXPECT_TRUE(Vehicle().step(slam, {}).drift.isZero());
}

}  // namespace
}  // namespace datmo::grid_slam_drift_test
