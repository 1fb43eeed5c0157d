// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/twist2.h"

#include <random>

#include <gtest/gtest.h>

namespace datmo::twist2_test {
namespace {

TEST(Arc, StraightAhead) {
  const Pose2 motion = arc({10.0, 0.0}, 0.5);
  EXPECT_DOUBLE_EQ(motion.x(), 5.0);
  EXPECT_DOUBLE_EQ(motion.y(), 0.0);
  EXPECT_DOUBLE_EQ(motion.heading(), 0.0);
}

TEST(Arc, QuarterCircleToTheLeft) {
  // Radius 2 m: a quarter of the circle in 1 s.
  const Pose2 motion = arc({kPi, kPi / 2.0}, 1.0);
  EXPECT_NEAR(motion.x(), 2.0, 1e-12);
  EXPECT_NEAR(motion.y(), 2.0, 1e-12);
  EXPECT_NEAR(motion.heading(), kPi / 2.0, 1e-12);
}

TEST(Arc, StandingCarTurnsOnTheSpot) {
  const Pose2 motion = arc({0.0, 1.0}, 0.5);
  EXPECT_DOUBLE_EQ(motion.position().norm(), 0.0);
  EXPECT_DOUBLE_EQ(motion.heading(), 0.5);
}

TEST(Arc, TwoHalvesMakeTheWhole) {
  const Twist2 twist{8.0, 0.7};
  const Pose2 halves = arc(twist, 0.5) * arc(twist, 0.5);
  const Pose2 whole = arc(twist, 1.0);
  EXPECT_NEAR((halves.position() - whole.position()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(halves.heading(), whole.heading(), 1e-12);
}

TEST(Arc, BackwardInTimeIsTheInverse) {
  const Pose2 there_and_back = arc({8.0, 0.7}, 1.0) * arc({8.0, 0.7}, -1.0);
  EXPECT_NEAR(there_and_back.position().norm(), 0.0, 1e-12);
  EXPECT_NEAR(there_and_back.heading(), 0.0, 1e-12);
}

TEST(TwistOf, UndoesArc) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> speed(-30.0, 30.0);
  std::uniform_real_distribution<double> yaw_rate(-3.0, 3.0);
  std::uniform_real_distribution<double> seconds(0.01, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Twist2 twist{speed(random), yaw_rate(random)};
    const double duration = seconds(random);
    const Twist2 found = twistOf(arc(twist, duration), duration);
    EXPECT_NEAR(found.forward_speed, twist.forward_speed, 1e-9);
    EXPECT_NEAR(found.yaw_rate, twist.yaw_rate, 1e-9);
  }
}

TEST(TwistOf, LeavesSidewaysMotionOut) {
  const Twist2 twist = twistOf({3.0, 1.0, 0.0}, 1.0);
  EXPECT_DOUBLE_EQ(twist.forward_speed, 3.0);
  EXPECT_DOUBLE_EQ(twist.yaw_rate, 0.0);
}

TEST(Screw, IsTheArcWithoutSidewaysMotion) {
  const Pose2 expected = arc({4.0, 0.6}, 2.0);
  const Pose2 found = screw({8.0, 0.0, 1.2});
  EXPECT_NEAR((found.position() - expected.position()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(found.heading(), 1.2, 1e-12);
  EXPECT_NEAR((screw({3.0, 1.0, 0.0}).position() - Point2(3.0, 1.0)).norm(), 0.0, 1e-12);
}

TEST(Screw, ItsPartsComposeToTheWholeMotion) {
  const Pose2 motion(2.0, -5.0, 2.5);
  const Eigen::Vector3d velocities = screwOf(motion);
  const Pose2 composed = screw(0.3 * velocities) * screw(0.7 * velocities);
  EXPECT_NEAR((composed.position() - motion.position()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(composed.heading(), 2.5, 1e-12);
}

}  // namespace
}  // namespace datmo::twist2_test
