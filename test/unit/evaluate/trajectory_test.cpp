// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/trajectory.h"

#include "evaluate/made_recordings.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::trajectory_test {
namespace {

constexpr double kMaxGap = 0.5;  // s

void expectPose(const std::optional<Pose2>& pose, const Pose2& expected) {
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->x(), expected.x(), 1e-9);
  EXPECT_NEAR(pose->y(), expected.y(), 1e-9);
  EXPECT_NEAR(angleBetween(pose->heading(), expected.heading()), 0.0, 1e-9);
}

TEST(Trajectory, IsExactAtItsStamps) {
  const Trajectory trajectory({poseAt(1.0, Pose2(1, 2, 0.3)), poseAt(1.1, Pose2(2, 2, 0.4))},
                              kMaxGap);
  expectPose(trajectory.at(Stamp::fromSeconds(1.0)), Pose2(1, 2, 0.3));
  expectPose(trajectory.at(Stamp::fromSeconds(1.1)), Pose2(2, 2, 0.4));
}

TEST(Trajectory, InterpolatesAlongTheMotionAndTheShorterTurn) {
  const Trajectory trajectory({poseAt(1.0, Pose2(0, 0, 3.1)), poseAt(1.2, Pose2(2, 4, -3.1))},
                              kMaxGap);
  const auto pose = trajectory.at(Stamp::fromSeconds(1.1));
  expectPose(pose, Pose2(1, 2, kPi));
}

TEST(Trajectory, ExtrapolatesByAtMostOneStep) {
  const Trajectory trajectory({poseAt(1.0, Pose2(0, 0, 0)), poseAt(1.1, Pose2(1, 0, 0))}, kMaxGap);
  expectPose(trajectory.at(Stamp::fromSeconds(1.15)), Pose2(1.5, 0, 0));
  expectPose(trajectory.at(Stamp::fromSeconds(0.95)), Pose2(-0.5, 0, 0));
  EXPECT_FALSE(trajectory.at(Stamp::fromSeconds(1.21)));
  EXPECT_FALSE(trajectory.at(Stamp::fromSeconds(0.89)));
}

TEST(Trajectory, IsUnknownInALongGap) {
  const Trajectory trajectory({poseAt(1.0, Pose2(0, 0, 0)), poseAt(1.6, Pose2(1, 0, 0))}, kMaxGap);
  EXPECT_FALSE(trajectory.at(Stamp::fromSeconds(1.1)));
  EXPECT_TRUE(trajectory.at(Stamp::fromSeconds(1.6)));
}

TEST(Trajectory, OnePoseOrNoneHasNoMotion) {
  const Trajectory one({poseAt(1.0, Pose2(3, 0, 0))}, kMaxGap);
  expectPose(one.at(Stamp::fromSeconds(1.0)), Pose2(3, 0, 0));
  EXPECT_FALSE(one.at(Stamp::fromSeconds(1.01)));
  EXPECT_FALSE(Trajectory({}, kMaxGap).at(Stamp::fromSeconds(1.0)));
}

TEST(AlignAtFirstPose, AlignsTheFirstCommonPoses) {
  const Trajectory truth({poseAt(2.0, Pose2(5, 1, kPi / 2)), poseAt(2.1, Pose2(5, 2, kPi / 2))},
                         kMaxGap);
  const Trajectory run({poseAt(1.0, Pose2(9, 9, 1)), poseAt(2.0, Pose2(1, 0, 0))}, kMaxGap);
  const auto alignment = alignAtFirstPose(run, truth);
  ASSERT_TRUE(alignment);
  EXPECT_EQ(alignment->stamp, Stamp::fromSeconds(2.0));
  // One meter ahead of the run's vehicle is one meter along y of the truth.
  const Point2 ahead = alignment->run_in_truth * Point2(2.0, 0.0);
  EXPECT_NEAR(ahead.x(), 5.0, 1e-9);
  EXPECT_NEAR(ahead.y(), 2.0, 1e-9);
}

TEST(AlignAtFirstPose, NeedsAnOverlap) {
  const Trajectory truth({poseAt(2.0, Pose2()), poseAt(2.1, Pose2())}, kMaxGap);
  EXPECT_FALSE(alignAtFirstPose(Trajectory({poseAt(7.0, Pose2())}, kMaxGap), truth));
}

}  // namespace
}  // namespace datmo::evaluation::trajectory_test
