// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/pose_graph.h"

#include <cmath>

#include <gtest/gtest.h>

#include "datmo_fusion/slam/pose_covariance.h"

namespace datmo::pose_graph_test {
namespace {

Eigen::Matrix3d covariance(double position_sigma, double heading_sigma) {
  return Eigen::Vector3d(position_sigma * position_sigma, position_sigma * position_sigma,
                         heading_sigma * heading_sigma)
      .asDiagonal();
}

PoseGraph graph(double loss_scale = 100.0) {
  PoseGraphOptions options;
  options.loss_scale = loss_scale;
  return PoseGraph(options);
}

TEST(PoseGraphTest, EqualMotionsShareTheErrorOfALoop) {
  PoseGraph poses = graph();
  poses.start(Pose2());
  poses.extend(Pose2(1.0, 0.0, 0.0), covariance(1.0, 1.0));
  poses.extend(Pose2(1.0, 0.0, 0.0), covariance(1.0, 1.0));
  poses.close({0, 2, Pose2(2.3, 0.0, 0.0), covariance(1.0, 1.0)});
  ASSERT_TRUE(poses.optimize());
  // Least sum of (a - 1)^2 + (b - 1)^2 + (a + b - 2.3)^2.
  EXPECT_NEAR(poses.poses()[1].x(), 1.1, 1e-3);
  EXPECT_NEAR(poses.poses()[2].x(), 2.2, 1e-3);
  EXPECT_EQ(poses.poses()[0].x(), 0.0);
  EXPECT_NEAR(poses.squaredError(poses.loops().front()), 0.01, 1e-4);
}

TEST(PoseGraphTest, TheMoreCertainMotionIsCorrectedLess) {
  PoseGraph poses = graph();
  poses.start(Pose2());
  poses.extend(Pose2(1.0, 0.0, 0.0), covariance(1.0, 1.0));
  poses.extend(Pose2(1.0, 0.0, 0.0), covariance(2.0, 1.0));
  poses.close({0, 2, Pose2(2.6, 0.0, 0.0), covariance(1.0, 1.0)});
  ASSERT_TRUE(poses.optimize());
  // Variances 1, 4 and 1 of 6 share the 0.6 m.
  EXPECT_NEAR(poses.poses()[1].x(), 1.1, 1e-3);
  EXPECT_NEAR(poses.poses()[2].x(), 2.5, 1e-3);
}

TEST(PoseGraphTest, ASquareWithAWrongTurnIsClosed) {
  PoseGraph poses = graph();
  poses.start(Pose2(1.0, 2.0, 0.5));
  for (int i = 0; i < 4; ++i) {
    poses.extend(Pose2(10.0, 0.0, degrees(91.0)), covariance(0.1, degrees(1.0)));
  }
  EXPECT_GT((poses.poses()[4].position() - poses.poses()[0].position()).norm(), 0.4);
  poses.close({0, 4, Pose2(), covariance(0.001, degrees(0.01))});
  ASSERT_TRUE(poses.optimize());
  EXPECT_NEAR((poses.poses()[4].position() - poses.poses()[0].position()).norm(), 0.0, 0.02);
  for (int i = 0; i < 4; ++i) {
    const Pose2 motion = poses.poses()[i].inverse() * poses.poses()[i + 1];
    EXPECT_NEAR(motion.heading(), degrees(90.0), degrees(0.2)) << i;
    EXPECT_NEAR(motion.position().norm(), 10.0, 0.1) << i;
  }
}

TEST(PoseGraphTest, HeadingsBeyondHalfATurnAreNoError) {
  PoseGraph poses = graph();
  poses.start(Pose2(0.0, 0.0, degrees(179.0)));
  poses.extend(Pose2(1.0, 0.0, degrees(2.0)), covariance(0.1, 0.1));
  poses.close({0, 1, Pose2(1.0, 0.0, degrees(2.0)), covariance(0.1, 0.1)});
  EXPECT_NEAR(poses.squaredError(poses.loops().front()), 0.0, 1e-12);
  ASSERT_TRUE(poses.optimize());
  EXPECT_NEAR(poses.poses()[1].heading(), degrees(-179.0), 1e-6);
}

TEST(PoseGraphTest, AFalseLoopDoesNotTearTheGraphApart) {
  PoseGraph poses = graph(2.0);
  poses.start(Pose2());
  for (int i = 0; i < 10; ++i) {
    poses.extend(Pose2(1.0, 0.0, 0.0), covariance(0.02, 0.01));
  }
  poses.close({0, 10, Pose2(10.0, 0.0, 0.0), covariance(0.02, 0.01)});
  poses.close({1, 9, Pose2(1.0, 3.0, 0.5), covariance(0.02, 0.01)});
  ASSERT_TRUE(poses.optimize());
  EXPECT_LT((poses.poses()[9].position() - Point2(9.0, 0.0)).norm(), 0.1);
  EXPECT_EQ(poses.removeLoops(16.0), 1U);
  ASSERT_EQ(poses.loops().size(), 1U);
  EXPECT_EQ(poses.loops().front().to, 10U) << "the true one stays";
}

TEST(PoseGraphTest, ANonFiniteLoopIsRemoved) {
  PoseGraph poses = graph();
  poses.start(Pose2());
  poses.extend(Pose2(1.0, 0.0, 0.0), covariance(1.0, 1.0));
  poses.close({0, 1, Pose2(1.5, 0.0, 0.0), covariance(1.0, 1.0)});
  ASSERT_TRUE(poses.optimize());
  poses.close({0, 1, Pose2(std::nan(""), 0.0, 0.0), covariance(1.0, 1.0)});
  EXPECT_FALSE(poses.optimize());
  EXPECT_EQ(poses.loops().size(), 1U);
  EXPECT_NEAR(poses.poses()[1].x(), 1.25, 1e-3);
  EXPECT_TRUE(poses.optimize());
}

/// 100 m straight on, 10 m from one pose to the next.
PoseGraph straightOn() {
  PoseGraph poses = graph();
  poses.start(Pose2(0.0, 0.0, 0.5));
  for (int i = 0; i < 10; ++i) {
    poses.extend(Pose2(10.0, 0.0, 0.0), covariance(0.1, 0.01));
  }
  return poses;
}

TEST(PoseGraphTest, UncertaintyGrowsWithTheDistanceDriven) {
  const PoseGraph poses = straightOn();
  // Each motion adds 0.1^2; its heading turns the remaining 90, 80 .. 0 m.
  const double across = 10 * 0.01 + 0.0001 * 100.0 * (81 + 64 + 49 + 36 + 25 + 16 + 9 + 4 + 1);
  const Eigen::Matrix3d end = rotated(poses.covariancesOf(10)[0], -0.5);
  EXPECT_NEAR(end(0, 0), 0.1, 1e-9);
  EXPECT_NEAR(end(1, 1), across, 1e-9);
  EXPECT_NEAR(end(2, 2), 10 * 0.0001, 1e-12);
  EXPECT_TRUE(poses.covarianceBetween(0, 10).isApprox(poses.covariancesOf(10)[0]));
  EXPECT_TRUE(poses.covarianceBetween(10, 10).isZero());
  // From the other end the headings turn 10, 20 .. 100 m.
  const Eigen::Matrix3d back = rotated(poses.covarianceBetween(10, 0), -0.5);
  EXPECT_NEAR(back(1, 1), across + 0.0001 * 100.0 * 100, 1e-9);
}

TEST(PoseGraphTest, ALoopReducesOnlyTheUncertaintyBetweenItsEnds) {
  PoseGraph poses = straightOn();
  poses.close({0, 10, Pose2(100.0, 0.0, 0.0), covariance(0.1, 0.001)});
  EXPECT_LT(maxPositionVariance(poses.covarianceBetween(0, 10)), 0.03);
  EXPECT_GT(maxPositionVariance(poses.covarianceBetween(5, 10)), 0.3)
      << "the middle is as far from both ends as before";
  const std::vector<Eigen::Matrix3d> of_9 = poses.covariancesOf(9);
  EXPECT_LT(maxPositionVariance(of_9[1]), maxPositionVariance(straightOn().covarianceBetween(1, 9)))
      << "round by the loop";
}

TEST(PoseGraphTest, NothingToOptimizeIsNoFault) {
  PoseGraph poses = graph();
  poses.start(Pose2(1.0, 2.0, 3.0));
  EXPECT_TRUE(poses.optimize());
  EXPECT_EQ(poses.poses().front().x(), 1.0);
}

}  // namespace
}  // namespace datmo::pose_graph_test
