// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/odometry_anchor.h"

#include <gtest/gtest.h>

namespace datmo::odometry_anchor_test {
namespace {

Stamp at(double seconds) { return Stamp::fromSeconds(seconds); }

/// A robot that turns on the spot at 0.5 rad/s, whose filter knows where it is at 1 s.
class OdometryAnchorTest : public ::testing::Test {
 protected:
  OdometryAnchorTest() {
    PoseFilterOptions uncalibrated;
    uncalibrated.calibrate_odometry = false;
    filter_ = PoseFilter(uncalibrated, {});
    odometryAt(1.0);
    anchor_.keep(at(1.0), filter_, odometry_);
  }

  void odometryAt(double seconds) {
    odometry_.add({at(seconds), {0.0, 0.5}, Pose2(7.0, 3.0, 0.5 * seconds)});
  }

  /// The filter after a match that gave the robot this heading.
  PoseFilter matchedAt(double heading) const {
    PoseFilter matched = filter_;
    matched.predictUnmeasured(0.1);
    matched.correct({Pose2(0.0, 0.0, heading), 1e-4 * Eigen::Matrix3d::Identity()});
    return matched;
  }

  PoseFilter filter_{{}, {}};
  OdometryBuffer odometry_{0.5, 10.0};
  OdometryAnchor anchor_;
};

TEST_F(OdometryAnchorTest, PosesAfterAGapContradictAWrongMatch) {
  anchor_.keep(at(3.0), matchedAt(0.0), odometry_);
  EXPECT_FALSE(anchor_.correction(at(3.1), matchedAt(0.0), odometry_)) << "still silent";
  odometryAt(3.1);
  const auto corrected = anchor_.correction(at(3.1), matchedAt(0.0), odometry_);
  ASSERT_TRUE(corrected);
  EXPECT_NEAR(corrected->pose().pose.heading(), 0.5 * 2.1, 1e-9);
  EXPECT_NEAR(corrected->pose().pose.position().norm(), 0.0, 1e-9);
  EXPECT_GT(corrected->pose().covariance(2, 2), 1e-3) << "of a turn of 2.1 s";
}

TEST_F(OdometryAnchorTest, MatchesThatAgreeAreKept) {
  odometryAt(3.0);
  EXPECT_FALSE(anchor_.correction(at(3.0), matchedAt(1.0), odometry_));
}

TEST_F(OdometryAnchorTest, TheScanNearestToTheLastPoseIsTheAnchor) {
  anchor_.keep(at(1.2), matchedAt(0.7), odometry_);  // of the same pose, but later
  odometryAt(3.0);
  EXPECT_NEAR(anchor_.correction(at(3.0), matchedAt(-1.0), odometry_)->pose().pose.heading(), 1.0,
              1e-9);
  anchor_.keep(at(3.0), matchedAt(-1.0), odometry_);
  odometryAt(4.0);
  EXPECT_NEAR(anchor_.correction(at(4.0), matchedAt(1.0), odometry_)->pose().pose.heading(), -0.5,
              1e-9);
}

TEST_F(OdometryAnchorTest, OdometryWithoutPosesCorrectsNothing) {
  odometry_.add({at(3.0), {0.0, 0.5}});
  EXPECT_FALSE(anchor_.correction(at(3.0), matchedAt(-1.0), odometry_));
  anchor_.keep(at(3.0), matchedAt(-1.0), odometry_);
  odometryAt(5.0);
  EXPECT_FALSE(anchor_.correction(at(5.0), matchedAt(2.0), odometry_));
}

}  // namespace
}  // namespace datmo::odometry_anchor_test
