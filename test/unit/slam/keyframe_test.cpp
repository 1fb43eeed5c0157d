// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/keyframe.h"

#include "drift_drive.h"
#include <gtest/gtest.h>

#include "datmo_fusion/slam/keyframe_selector.h"

namespace datmo::keyframe_test {
namespace {

using Use = KeyframeSelector::Use;

TEST(KeptScanTest, EndsAreRestoredToWithinAFewMillimeters) {
  const Scan scan = Yard().scan(Pose2(), 0.0);
  const KeptScan kept(labeled(scan, Pose2()));
  EXPECT_EQ(kept.bytes(), 4 * scan.rays.size());
  const Scan again = kept.scan(scan.stamp);
  ASSERT_EQ(again.rays.size(), scan.rays.size());
  for (std::size_t i = 0; i < scan.rays.size(); ++i) {
    EXPECT_LT((again.rays[i].end - scan.rays[i].end).norm(), 0.004);
    EXPECT_NEAR(again.rays[i].range, scan.rays[i].range, 0.004);
    EXPECT_TRUE(again.rays[i].hit);
  }
}

TEST(KeptScanTest, MoversAreLeftOutAndBeamsWithoutReturnAreFree) {
  LabeledScan scan = labeled(Yard().scan(Pose2(), 0.0), Pose2());
  scan.field.free_range = 40.0;
  scan.blind_beams = {3};
  scan.points.resize(3);  // of beams 0 to 2
  scan.points[1].state = PointState::kMoving;
  const Scan kept = KeptScan(scan).scan(scan.stamp);
  ASSERT_EQ(kept.rays.size(), 2U + 77U);
  EXPECT_FALSE(kept.rays.back().hit);
  EXPECT_NEAR(kept.rays.back().range, 40.0, 1e-9);
  EXPECT_NEAR(kept.rays.back().end.y(), 40.0 * std::sin(degrees(80.0)), 1e-6);
}

TEST(KeptScanTest, DistantEndsAreLeftOut) {
  LabeledScan scan;
  scan.points = {{Point2(170.0, 0.0), 170.0, 0.0, 0, PointState::kStatic}};
  EXPECT_TRUE(KeptScan(scan).empty());
}

class KeyframeSelectorTest : public testing::Test {
 protected:
  Use take(double seconds, double x, double sigma) {
    const Eigen::Matrix3d covariance =
        Eigen::Vector3d(sigma * sigma, sigma * sigma, 1e-4).asDiagonal();
    return selector_.select(Stamp::fromSeconds(1000.0 + seconds), {Pose2(x, 0.0, 0.0), covariance});
  }

  KeyframeSelector selector_{KeyframeOptions()};
};

TEST_F(KeyframeSelectorTest, AScanIsKeptEveryMeter) {
  EXPECT_EQ(take(0.0, 0.0, 0.1), Use::kFirst);
  EXPECT_EQ(take(0.1, 0.6, 0.1), Use::kPose);
  EXPECT_EQ(take(0.2, 1.2, 0.1), Use::kKeyframe);
  EXPECT_EQ(take(0.3, 1.8, 0.1), Use::kPose);
}

TEST_F(KeyframeSelectorTest, AfterAGapTheDriveContinuesWhenTheVehicleIsFound) {
  take(0.0, 0.0, 0.1);
  EXPECT_EQ(take(3.0, 20.0, 5.0), Use::kNothing);
  EXPECT_EQ(take(4.0, 25.0, 5.0), Use::kNothing);
  EXPECT_EQ(take(5.0, 31.0, 0.3), Use::kKeyframe);
}

TEST_F(KeyframeSelectorTest, ANewMapStartsANewDrive) {
  take(0.0, 0.0, 0.1);
  EXPECT_EQ(take(3.0, 20.0, 5.0), Use::kNothing);
  EXPECT_EQ(take(10.1, 40.0, 5.0), Use::kFirst);
  EXPECT_EQ(take(10.2, 41.2, 5.0), Use::kKeyframe) << "no less certain than its start";
}

TEST_F(KeyframeSelectorTest, APoseJumpStartsANewDrive) {
  take(0.0, 0.0, 0.1);
  EXPECT_EQ(take(1.0, 50.0, 0.1), Use::kKeyframe) << "as fast as a vehicle may be";
  EXPECT_EQ(take(1.1, 0.0, 0.1), Use::kFirst) << "the SLAM has started over at its origin";
  EXPECT_EQ(take(1.2, 1.2, 0.1), Use::kKeyframe);
}

TEST_F(KeyframeSelectorTest, AfterALongGapTheDriveContinues) {
  take(0.0, 0.0, 0.1);
  take(1.0, 1.5, 0.1);
  EXPECT_EQ(take(11.0, 200.0, 0.1), Use::kKeyframe);
}

TEST_F(KeyframeSelectorTest, LocalizationInAPriorMapStartsANewDrive) {
  EXPECT_EQ(take(0.0, 0.0, 30.0), Use::kNothing);
  EXPECT_EQ(take(7.0, 5.0, 30.0), Use::kFirst);
  EXPECT_EQ(take(8.0, 80.0, 0.1), Use::kFirst) << "the frame of what was before is another";
}

}  // namespace
}  // namespace datmo::keyframe_test
