// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/scan_merge_stage.h"

#include <cmath>

#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

namespace datmo::scan_merge_stage_test {
namespace {

using samples::kStart;

constexpr double kSpeed = 10.0;  // m/s

ScanMergeStageOptions options() {
  ScanMergeStageOptions all;
  all.merger.beam_spacing = 0.1;
  return all;
}

constexpr std::size_t kBehind = 0;
constexpr std::size_t kAhead = 31;

class ScanMergeStageTest : public testing::Test {
 protected:
  /// One scanner 3 m ahead of the vehicle's origin, one 1 m behind it that faces backward.
  ScanMergeStageTest() {
    auto front = samples::transform("base_link", "front_laser", 3.0);
    front.transform.translation.z = 0.4;
    auto rear = samples::transform("base_link", "rear_laser", -1.0);
    rear.transform.rotation.w = 0.0;
    rear.transform.rotation.z = 1.0;
    buffer_.addStatic(samples::transforms({front, rear}));
  }

  /// `ahead`: range of the scanner's middle beam, m; the others hit 2 m beside it.
  static sensor_msgs::LaserScan scanFrom(const std::string& source, double seconds, float ahead) {
    auto scan = samples::laserScan({2.0F, ahead, 2.0F});
    scan.header.frame_id = source + "_laser";
    scan.header.stamp = ros::Time(kStart + seconds);
    return scan;
  }

  void handle(const std::string& source, double seconds, float ahead) {
    stage_.handleScan(source, scanFrom(source, seconds, ahead),
                      Stamp::fromSeconds(kStart + seconds));
  }

  void drive(double seconds) { stage_.handleOdometry(samples::odometry(kStart + seconds, kSpeed)); }

  sensor_msgs::LaserScanPtr next(double seconds) {
    return stage_.next(Stamp::fromSeconds(kStart + seconds));
  }

  TransformBuffer buffer_{1.0};
  StageMonitor monitor_{"scan_merge"};
  ScanMergeStage stage_{options(), buffer_, monitor_};
};

TEST_F(ScanMergeStageTest, TheRearScanIsCompensatedToTheFrontsStamp) {
  drive(0.0);
  drive(0.1);
  handle("rear", 0.10, 5.0F);  // the wall is at x = -6 m
  EXPECT_FALSE(next(0.10));
  handle("front", 0.15, 7.0F);
  const auto scan = next(0.21);  // no newer scan of the rear scanner arrives in time
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->header.stamp, ros::Time(kStart + 0.15));
  EXPECT_EQ(scan->header.frame_id, "merged_scan");
  EXPECT_NEAR(scan->ranges[kAhead], 3.0 + 7.0, 1e-5);
  EXPECT_NEAR(scan->ranges[kBehind], 1.0 + 5.0 + 0.05 * kSpeed, 1e-5);
  EXPECT_TRUE(std::isnan(scan->ranges[kAhead + 2]));
  EXPECT_NEAR(scan->angle_min, -M_PI, 1e-6);
  EXPECT_EQ(scan->time_increment, 0.0F);
  EXPECT_EQ(monitor_.figures().at("scans merged"), 2.0);
}

TEST_F(ScanMergeStageTest, BeamsOfOneScanAreCompensatedToo) {
  drive(0.0);
  drive(0.1);
  auto scan = scanFrom("front", 0.1, 7.0F);
  scan.time_increment = 0.05F;  // the middle beam is measured 0.5 m further on
  stage_.handleScan("front", scan, Stamp::fromSeconds(kStart + 0.1));
  handle("rear", 0.1, 5.0F);
  const auto merged = next(0.2);
  ASSERT_TRUE(merged);
  EXPECT_NEAR(merged->ranges[kAhead], 10.5, 1e-5);
  EXPECT_NEAR(merged->ranges[kBehind], 6.0, 1e-5);
}

TEST_F(ScanMergeStageTest, ASilentScannerIsReportedAndTheOtherContinues) {
  drive(0.0);
  handle("rear", 0.0, 5.0F);
  handle("front", 0.0, 7.0F);
  EXPECT_TRUE(next(0.0));
  for (int i = 1; i <= 10; ++i) {
    const double now = 0.1 * i;
    drive(now);
    handle("front", now, 7.0F + 0.01F * static_cast<float>(i));
    const auto scan = next(now + 0.06);
    ASSERT_TRUE(scan) << now;
    EXPECT_NEAR(scan->ranges[kAhead], 10.0 + 0.01 * i, 1e-5);
    EXPECT_TRUE(std::isnan(scan->ranges[kBehind])) << "not measured is not free";
  }
  EXPECT_EQ(samples::warnings(monitor_, "silent_source"), 1U);
}

TEST_F(ScanMergeStageTest, TheRearScannerLeadsWhileTheFrontOneIsSilent) {
  drive(0.0);
  handle("front", 0.0, 7.0F);
  int merged = 0;
  for (int i = 0; i <= 10; ++i) {
    drive(0.1 * i);
    handle("rear", 0.1 * i, 5.0F + 0.01F * static_cast<float>(i));
    while (const auto scan = next(0.1 * i)) {
      ++merged;
      EXPECT_FALSE(std::isnan(scan->ranges[kBehind]));
    }
  }
  EXPECT_GE(merged, 6);
}

TEST_F(ScanMergeStageTest, AFrozenScannerIsLeftOut) {
  for (int i = 0; i <= 8; ++i) {
    drive(0.1 * i);
    auto frozen = scanFrom("rear", 0.1 * i, 5.0F);
    frozen.ranges.assign(31, 5.0F);  // this many are not equal by chance
    frozen.angle_increment = static_cast<float>(M_PI / 30.0);
    stage_.handleScan("rear", frozen, Stamp::fromSeconds(kStart + 0.1 * i));
    handle("front", 0.1 * i, 7.0F + 0.01F * static_cast<float>(i));
    next(0.1 * i + 0.06);
  }
  EXPECT_GE(samples::drops(monitor_, "frozen_scan"), 1U);
}

TEST_F(ScanMergeStageTest, ABlindSectorIsNotMeasured) {
  auto blind = options();
  blind.sources["rear"].blind_sectors = {-0.1, 0.1};
  ScanMergeStage stage(blind, buffer_, monitor_);
  stage.handleOdometry(samples::odometry(kStart, kSpeed));
  stage.handleScan("rear", scanFrom("rear", 0.0, 5.0F), Stamp::fromSeconds(kStart));
  stage.handleScan("front", scanFrom("front", 0.0, 7.0F), Stamp::fromSeconds(kStart));
  const auto scan = stage.next(Stamp::fromSeconds(kStart));
  ASSERT_TRUE(scan);
  EXPECT_TRUE(std::isnan(scan->ranges[kBehind]));
  EXPECT_FALSE(std::isnan(scan->ranges[kAhead]));
}

TEST_F(ScanMergeStageTest, TheMountIsAtTheFrontScannersHeight) {
  drive(0.0);
  handle("rear", 0.0, 5.0F);
  handle("front", 0.0, 7.0F);
  ASSERT_TRUE(next(0.0));
  const auto mount = stage_.takeMount();
  ASSERT_TRUE(mount);
  EXPECT_EQ(mount->header.frame_id, "base_link");
  EXPECT_EQ(mount->child_frame_id, "merged_scan");
  EXPECT_DOUBLE_EQ(mount->transform.translation.z, 0.4);
  EXPECT_FALSE(stage_.takeMount());
}

TEST_F(ScanMergeStageTest, AScanOfAScannerWithoutAMountIsDropped) {
  auto scan = scanFrom("front", 0.0, 7.0F);
  scan.header.frame_id = "roof_laser";
  stage_.handleScan("front", scan, Stamp::fromSeconds(kStart));
  EXPECT_EQ(samples::drops(monitor_, "missing_transform"), 1U);
}

TEST(ScanMergeStageOptionsTest, HalfASectorIsRefused) {
  auto half = options();
  half.sources["rear"].blind_sectors = {0.1};
  EXPECT_THROW(checkOptions(half), OptionError);
}

}  // namespace
}  // namespace datmo::scan_merge_stage_test
