// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/pose_motion.h"

#include <gtest/gtest.h>

namespace datmo::pose_motion_test {
namespace {

constexpr double kPeriod = 0.08;  // s

/// Of a vehicle at 8 m/s.
PoseWithCovariance poseAt(int scan, double sigma = 0.02) {
  return {Pose2(8.0 * kPeriod * scan, 0.0, 0.0),
          Eigen::Vector3d(sigma * sigma, sigma * sigma, 1e-6).asDiagonal()};
}

Stamp stampOf(int scan) { return Stamp::fromSeconds(1000.0 + kPeriod * scan); }

TEST(PoseMotion, APoseThatIsFoundAgainIsNoSpeed) {
  PoseMotion motion{TwistGateOptions(), OdometryNoiseOptions()};
  EXPECT_FALSE(motion.add(stampOf(0), poseAt(0, 1.5)));
  for (int scan = 1; scan < 10; ++scan) {
    EXPECT_FALSE(motion.add(stampOf(scan), poseAt(scan, 1.5))->jumped);
  }
  const auto moved = [](PoseWithCovariance pose) {
    pose.pose = Pose2(1.5, 0.5, 0.0) * pose.pose;
    return pose;
  };
  EXPECT_TRUE(motion.add(stampOf(10), moved(poseAt(10)))->jumped);
  const auto step = motion.add(stampOf(11), moved(poseAt(11)));
  EXPECT_FALSE(step->jumped);
  EXPECT_NEAR(step->twist.forward_speed, 8.0, 1e-9);
  EXPECT_NEAR(step->traveled.x(), 8.0 * kPeriod * 11, 1e-9);
  EXPECT_NEAR(step->traveled.y(), 0.0, 1e-9);
}

TEST(PoseMotion, FullBrakingIsMotion) {
  PoseMotion motion{TwistGateOptions(), OdometryNoiseOptions()};
  for (int scan = 0; scan < 10; ++scan) {
    const double t = kPeriod * scan;
    PoseWithCovariance pose = poseAt(0);
    pose.pose = Pose2(8.0 * t - 5.0 * t * t, 0.0, 0.0);
    const auto step = motion.add(stampOf(scan), pose);
    EXPECT_FALSE(step && step->jumped) << scan;
  }
}

}  // namespace
}  // namespace datmo::pose_motion_test
