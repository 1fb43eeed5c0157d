// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/odometry_poses.h"

#include <gtest/gtest.h>

namespace datmo::odometry_poses_test {
namespace {

Stamp at(double seconds) { return Stamp::fromSeconds(seconds); }

/// Ahead at 10 m/s, starting from x = 0 at 100 s.
void addAt(double seconds, OdometryPoses& poses) {
  poses.add(at(seconds), {10.0, 0.0}, Pose2(10.0 * (seconds - 100.0), 2.0, 0.0));
}

TEST(OdometryPoses, TheLastPoseBeforeAStampIsMovedByItsTwist) {
  OdometryPoses poses(0.5);
  addAt(100.0, poses);
  poses.add(at(100.1), {20.0, 0.0}, Pose2(1.0, 2.0, 0.0));
  EXPECT_NEAR(poses.at(at(100.05))->x(), 0.5, 1e-9);
  EXPECT_NEAR(poses.at(at(100.2))->x(), 3.0, 1e-9);
  EXPECT_NEAR(poses.at(at(100.2))->y(), 2.0, 1e-9);
}

TEST(OdometryPoses, BeforeTheFirstOneItIsMovedBack) {
  OdometryPoses poses(0.5);
  addAt(100.0, poses);
  EXPECT_NEAR(poses.at(at(99.8))->x(), -2.0, 1e-9);
}

TEST(OdometryPoses, NoneIsUsedBeyondItsHold) {
  OdometryPoses poses(0.5);
  EXPECT_FALSE(poses.at(at(100.0)));
  addAt(100.0, poses);
  EXPECT_FALSE(poses.at(at(99.4)));
  EXPECT_FALSE(poses.at(at(100.6)));
  poses.clear();
  EXPECT_FALSE(poses.at(at(100.0)));
}

TEST(OdometryPoses, ThoseOfTheLastSecondsAreKept) {
  OdometryPoses poses(0.5);
  addAt(100.0, poses);
  addAt(109.9, poses);
  EXPECT_TRUE(poses.at(at(100.0)));
  addAt(110.1, poses);
  EXPECT_FALSE(poses.at(at(100.0)));
  EXPECT_TRUE(poses.at(at(109.9)));
}

}  // namespace
}  // namespace datmo::odometry_poses_test
