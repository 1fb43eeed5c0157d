// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/odometry_buffer.h"

#include <gtest/gtest.h>

namespace datmo::odometry_buffer_test {
namespace {

Stamp at(double seconds) { return Stamp::fromSeconds(seconds); }

class OdometryBufferTest : public ::testing::Test {
 protected:
  OdometryBuffer buffer_{0.5, 10.0};
};

TEST_F(OdometryBufferTest, IsEmptyAtFirst) { EXPECT_FALSE(buffer_.motion(at(1.0), at(1.1))); }

TEST_F(OdometryBufferTest, EachTwistHoldsUntilTheNext) {
  buffer_.add({at(1.0), {1.0, 0.0}});
  buffer_.add({at(1.2), {2.0, 0.0}});
  buffer_.add({at(1.4), {4.0, 0.0}});
  const auto motion = buffer_.motion(at(1.1), at(1.5));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->x(), 0.1 * 1.0 + 0.2 * 2.0 + 0.1 * 4.0, 1e-9);
}

TEST_F(OdometryBufferTest, PartsOfAMotionComposeToTheWhole) {
  for (int i = 0; i < 20; ++i) {
    buffer_.add({at(0.1 * i), {1.0 + i, 0.3 * i}});
  }
  const auto whole = buffer_.motion(at(0.25), at(1.75));
  const auto first = buffer_.motion(at(0.25), at(0.9));
  const auto second = buffer_.motion(at(0.9), at(1.75));
  ASSERT_TRUE(whole && first && second);
  const Pose2 composed = *first * *second;
  EXPECT_TRUE(composed.position().isApprox(whole->position(), 1e-9));
  EXPECT_NEAR(angleBetween(composed.heading(), whole->heading()), 0.0, 1e-9);
}

TEST_F(OdometryBufferTest, TheFirstSampleIsUsedForTheTimeJustBeforeIt) {
  buffer_.add({at(1.0), {2.0, 0.0}});
  const auto motion = buffer_.motion(at(0.9), at(1.1));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->x(), 0.4, 1e-9);
}

TEST_F(OdometryBufferTest, SilenceLongerThanTheHoldGivesNothing) {
  buffer_.add({at(1.0), {1.0, 0.0}});
  EXPECT_TRUE(buffer_.motion(at(1.0), at(1.5)));
  EXPECT_FALSE(buffer_.motion(at(1.0), at(1.6)));
  EXPECT_FALSE(buffer_.motion(at(0.3), at(1.1)));
  buffer_.add({at(4.0), {1.0, 0.0}});
  EXPECT_FALSE(buffer_.motion(at(1.2), at(4.1))) << "a gap in the middle";
}

TEST_F(OdometryBufferTest, PosesGiveTheMotionBetweenThemAlsoOverAGap) {
  const Pose2 first(5.0, -2.0, 0.4);
  const Pose2 motion = arc({1.5, 0.2}, 3.0);
  buffer_.add({at(1.0), {0.0, 0.0}, first});
  buffer_.add({at(4.0), {0.0, 0.0}, first * motion});
  const auto whole = buffer_.motion(at(1.0), at(4.0));
  ASSERT_TRUE(whole);
  EXPECT_TRUE(whole->position().isApprox(motion.position(), 1e-9));
  EXPECT_NEAR(angleBetween(whole->heading(), motion.heading()), 0.0, 1e-9);
  const auto third = buffer_.motion(at(2.0), at(3.0));
  ASSERT_TRUE(third);
  EXPECT_NEAR(third->heading(), 0.2, 1e-9);
}

TEST_F(OdometryBufferTest, PosesCountOverAGapLongerThanTheMemoryAndSidewaysToo) {
  const Pose2 motion(20.0, -7.0, 1.2);
  buffer_.add({at(1.0), {0.0, 0.0}, Pose2()});
  buffer_.add({at(41.0), {0.0, 0.0}, motion});
  const auto whole = buffer_.motion(at(1.0), at(41.0));
  ASSERT_TRUE(whole);
  EXPECT_TRUE(whole->position().isApprox(motion.position(), 1e-9));
  EXPECT_NEAR(whole->heading(), 1.2, 1e-9);
  EXPECT_TRUE(buffer_.hasPoses(at(1.0), at(41.0)));
  EXPECT_FALSE(buffer_.hasPoses(at(1.0), at(41.1))) << "after the last one";
  EXPECT_FALSE(buffer_.hasPoses(at(0.9), at(41.0))) << "before the first one";
}

TEST_F(OdometryBufferTest, IsOverdueOnceTheNextSampleShouldHaveCome) {
  EXPECT_EQ(buffer_.overdue(at(1.0)), 0.0) << "nothing is due yet";
  buffer_.add({at(1.0), {1.0, 0.0}});
  buffer_.add({at(1.1), {1.0, 0.0}});
  EXPECT_EQ(buffer_.overdue(at(1.05)), 0.0);
  EXPECT_EQ(buffer_.overdue(at(1.2)), 0.0);
  EXPECT_NEAR(buffer_.overdue(at(1.25)), 0.05, 1e-9);
  // In bursts of two.
  for (const double seconds : {1.2, 1.201, 1.3, 1.301}) {
    buffer_.add({at(seconds), {1.0, 0.0}});
  }
  EXPECT_EQ(buffer_.overdue(at(1.39)), 0.0);
}

TEST_F(OdometryBufferTest, APoseWithoutATwistIsUsedOnlyBackward) {
  OdometrySample counted{at(4.0), {0.0, 26.0}, Pose2(0.0, 0.0, 1.0)};
  counted.twist_measured = false;
  buffer_.add({at(1.0), {0.0, 0.0}, Pose2()});
  buffer_.add(counted);
  EXPECT_NEAR(buffer_.motion(at(1.0), at(4.0))->heading(), 1.0, 1e-9);
  EXPECT_FALSE(buffer_.motion(at(1.0), at(4.1))) << "how it moves now is not known";
  counted.stamp = at(4.2);
  counted.base_in_odom = Pose2(0.0, 0.0, 1.1);
  buffer_.add(counted);
  EXPECT_NEAR(buffer_.motion(at(4.0), at(4.4))->heading(), 0.2, 1e-9) << "as it just did";
}

TEST_F(OdometryBufferTest, APoseThatJumpsIsNoMotion) {
  buffer_.add({at(1.0), {1.0, 0.0}, Pose2(0.0, 0.0, 0.0)});
  buffer_.add({at(1.1), {1.0, 0.0}, Pose2(500.0, 0.0, 0.0)});
  EXPECT_NEAR(buffer_.motion(at(1.0), at(1.1))->x(), 0.1, 1e-9);
}

TEST_F(OdometryBufferTest, AJumpToTheSideIsNoMotionEither) {
  buffer_.add({at(1.0), {1.0, 0.0}, Pose2(0.0, 400.0, 0.0)});
  buffer_.add({at(3.0), {1.0, 0.0}, Pose2()});
  EXPECT_FALSE(buffer_.hasPoses(at(1.0), at(3.0)));
}

TEST_F(OdometryBufferTest, AfterTheLastPoseTheTwistHolds) {
  buffer_.add({at(1.0), {1.0, 0.0}, Pose2()});
  buffer_.add({at(1.1), {2.0, 0.0}, Pose2(0.05, 0.0, 0.0)});
  EXPECT_NEAR(buffer_.motion(at(1.0), at(1.2))->x(), 0.05 + 0.2, 1e-9);
}

TEST_F(OdometryBufferTest, LeavesOutSamplesThatAreNotNewer) {
  buffer_.add({at(1.0), {1.0, 0.0}});
  buffer_.add({at(1.0), {50.0, 0.0}});
  buffer_.add({at(0.5), {50.0, 0.0}});
  EXPECT_NEAR(buffer_.motion(at(1.0), at(1.1))->x(), 0.1, 1e-9);
}

TEST_F(OdometryBufferTest, KnownErrorsAreRemoved) {
  buffer_.add({at(1.0), {1.1, 0.25}});
  const auto motion = buffer_.motion(at(1.0), at(1.2), {0.1, 0.25});
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->x(), 0.2, 1e-9);
  EXPECT_NEAR(motion->heading(), 0.0, 1e-9);
}

TEST_F(OdometryBufferTest, WithoutAMeasuredSpeedTheYawRateTurnsTheAssumedOne) {
  OdometrySample turning{at(1.0), {0.0, 0.2}};
  turning.speed_measured = false;
  buffer_.add(turning);
  EXPECT_FALSE(buffer_.measuresSpeed());
  const auto motion = buffer_.motion(at(1.0), at(1.5), {}, 10.0);
  ASSERT_TRUE(motion);
  const Pose2 expected = arc({10.0, 0.2}, 0.5);
  EXPECT_NEAR((motion->position() - expected.position()).norm(), 0.0, 1e-9);
  EXPECT_NEAR(motion->heading(), 0.1, 1e-9);
  buffer_.add({at(1.5), {4.0, 0.0}});
  EXPECT_TRUE(buffer_.measuresSpeed());
}

}  // namespace
}  // namespace datmo::odometry_buffer_test
