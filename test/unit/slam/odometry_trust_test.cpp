// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/odometry_trust.h"

#include "yard.h"
#include <gtest/gtest.h>

#include "datmo_fusion/slam/grid_slam.h"

namespace datmo::odometry_trust_test {
namespace {

constexpr double kPeriod = 0.1;  // s

/// Of a vehicle at 5 m/s, whose odometry says `odometry_speed` (m/s).
void observe(OdometryTrust& trust, int scan, double odometry_speed) {
  const Stamp stamp = Stamp::fromSeconds(1000.0 + kPeriod * scan);
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.0025, 0.0025, 1e-5).asDiagonal();
  PoseFilter vehicle{PoseFilterOptions(), MotionModelOptions()};
  vehicle.restartAt({Pose2(5.0 * kPeriod * scan, 0.0, 0.0), covariance});
  trust.observeFrom(stamp, vehicle);
  trust.predict(arc({odometry_speed, 0.0}, kPeriod), kPeriod);
  trust.byScans().correct({Pose2(5.0 * kPeriod * (scan + 1), 0.0, 0.0), covariance});
  trust.judge(stamp + kPeriod, [] { return true; });
  trust.endWindow(stamp + kPeriod);
}

TEST(OdometryTrust, WhatContradictsTheScansOverAWindowIsNotTrustedUntilAWindowFits) {
  OdometryTrust trust{OdometryTrustOptions()};
  for (int scan = 0; scan < 100; ++scan) {
    observe(trust, scan, scan % 2 == 0 ? 5.3 : 4.7);
    EXPECT_TRUE(trust.isTrusted()) << "noise";
  }
  for (int scan = 100; scan < 130; ++scan) {
    observe(trust, scan, 8.0);
  }
  EXPECT_FALSE(trust.isTrusted());
  for (int scan = 130; scan < 150; ++scan) {
    observe(trust, scan, 5.0);
  }
  EXPECT_TRUE(trust.isTrusted());
}

TEST(OdometryTrust, TheWindowMustBePositive) {
  EXPECT_THROW(OdometryTrust(OdometryTrustOptions{0.0}), OptionError);
}

/// What the vehicle does: it brakes and turns while its odometry may be frozen.
Twist2 twistAt(double seconds) {
  return seconds < 3.0 ? Twist2{3.0, 0.0} : Twist2{seconds < 6.0 ? 1.0 : 3.0, 0.35};
}

struct Outcome {
  double max_error = 0.0;  // m
  int distrusted = 0;      // scans
  bool trusted_at_end = false;
};

Outcome drive(bool is_frozen) {
  GridSlam slam{GridSlamOptions{}};
  const Yard yard;
  Pose2 truth;
  Outcome outcome;
  for (int scan = 0; scan < 90; ++scan) {
    const double seconds = kPeriod * scan;
    const bool frozen_now = is_frozen && seconds > 2.5 && seconds < 5.5;
    slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds), twistAt(frozen_now ? 2.5 : seconds)});
    const SlamResult result = slam.process(yard.scan(truth, seconds));
    outcome.max_error = std::max(
        outcome.max_error, (result.split.base_in_map.pose.position() - truth.position()).norm());
    outcome.distrusted += result.odometry_used || scan == 0 ? 0 : 1;
    outcome.trusted_at_end = result.odometry_trusted;
    truth = truth * arc(twistAt(seconds), kPeriod);
  }
  return outcome;
}

TEST(OdometryTrust, FrozenOdometryIsNotFollowed) {
  const Outcome outcome = drive(true);
  EXPECT_LT(outcome.max_error, 0.4);
  EXPECT_GT(outcome.distrusted, 10);
  EXPECT_TRUE(outcome.trusted_at_end);
}

TEST(OdometryTrust, RightOdometryIs) {
  const Outcome outcome = drive(false);
  EXPECT_LT(outcome.max_error, 0.4);
  EXPECT_EQ(outcome.distrusted, 0);
}

}  // namespace
}  // namespace datmo::odometry_trust_test
