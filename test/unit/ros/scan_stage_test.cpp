// SPDX-License-Identifier: BSD-3-Clause
// Common to all stages that process a scanner's scans.
#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/grid_slam_stage.h"
#include "datmo_fusion/ros/stage/lidar_grid_stage.h"

namespace datmo::scan_stage_test {
namespace {

template <typename ScanStage>
class ScanStageTest : public testing::Test {
 protected:
  void mountScanner() {
    buffer_.addStatic(samples::transforms({samples::transform("base_link", "scanner", 3.6)}));
  }

  /// Returns whether a scan with this stamp was accepted.
  bool scanAt(double seconds) {
    auto scan = samples::laserScan();
    scan.header.stamp = ros::Time(seconds);
    return static_cast<bool>(stage_.handleScan(scan));
  }

  std::uint64_t drops(const std::string& reason) const { return samples::drops(monitor_, reason); }

  TransformBuffer buffer_{1.0};
  StageMonitor monitor_{"scan_stage"};
  ScanStage stage_{typename ScanStage::Options(), buffer_, monitor_};
};

using ScanStages = testing::Types<GridSlamStage, LidarGridStage>;
TYPED_TEST_SUITE(ScanStageTest, ScanStages);

TYPED_TEST(ScanStageTest, AMissingMountIsCountedUntilItArrives) {
  EXPECT_FALSE(this->scanAt(100.0));
  EXPECT_EQ(this->drops("missing_transform"), 1U);
  this->mountScanner();
  EXPECT_TRUE(this->scanAt(100.0)) << "the dropped scan has not moved the time";
}

TYPED_TEST(ScanStageTest, RepeatedOldAndTimelessScansAreDropped) {
  this->mountScanner();
  EXPECT_TRUE(this->scanAt(100.0));
  EXPECT_FALSE(this->scanAt(100.0));
  EXPECT_FALSE(this->scanAt(99.5));
  EXPECT_FALSE(this->scanAt(0.0));
  EXPECT_EQ(this->drops("repeated_stamp"), 1U);
  EXPECT_EQ(this->drops("old_stamp"), 1U);
  EXPECT_EQ(this->drops("zero_stamp"), 1U);
  EXPECT_TRUE(this->scanAt(100.1));
}

}  // namespace
}  // namespace datmo::scan_stage_test
