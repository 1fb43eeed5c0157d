// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/pose_covariance.h"

#include <gtest/gtest.h>

namespace datmo::pose_covariance_test {
namespace {

const Eigen::Matrix3d kCovariance = Eigen::Vector3d(0.01, 0.04, 0.25).asDiagonal();

TEST(PoseCovarianceTest, AHeadingErrorMovesDistantPoints) {
  const Eigen::Matrix3d far = withLeverArm(kCovariance, {10.0, 0.0});
  EXPECT_NEAR(far(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(far(1, 1), 0.04 + 100.0 * 0.25, 1e-12);
  EXPECT_NEAR(far(1, 2), 10.0 * 0.25, 1e-12);
  EXPECT_NEAR(far(2, 2), 0.25, 1e-12);
  EXPECT_TRUE(withLeverArm(far, {-10.0, 0.0}).isApprox(kCovariance));
}

TEST(PoseCovarianceTest, RotatedAxesKeepTheirSize) {
  const Eigen::Matrix3d left = rotated(kCovariance, kPi / 2.0);
  EXPECT_NEAR(left(0, 0), 0.04, 1e-12);
  EXPECT_NEAR(left(1, 1), 0.01, 1e-12);
  EXPECT_NEAR(left(2, 2), 0.25, 1e-12);
  const Eigen::Matrix3d oblique = rotated(kCovariance, degrees(30.0));
  EXPECT_LT(oblique(0, 1), -0.01) << "long across, so that the far end is ahead to the right";
  EXPECT_NEAR(maxPositionVariance(oblique), 0.04, 1e-12);
}

TEST(PoseCovarianceTest, ADifferenceIsAlongTheCommonAxesAndItsTurnIsTheSmallerOne) {
  const Eigen::Vector3d difference =
      differenceOf(Pose2(1.0, 2.0, degrees(170.0)), Pose2(4.0, 0.0, degrees(-170.0)));
  EXPECT_NEAR(difference[0], 3.0, 1e-12);
  EXPECT_NEAR(difference[1], -2.0, 1e-12);
  EXPECT_NEAR(difference[2], degrees(20.0), 1e-12);
}

}  // namespace
}  // namespace datmo::pose_covariance_test
