// SPDX-License-Identifier: BSD-3-Clause
// Whether the vehicle is located: on the topic `localization` and in the diagnostics.
#include <string>
#include <vector>

#include "message_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/grid_slam_stage.h"

namespace datmo::grid_slam_localization_test {
namespace {

constexpr int kBeams = 181;

class GridSlamLocalizationTest : public testing::Test {
 protected:
  GridSlamLocalizationTest() {
    buffer_.addStatic(samples::transforms({samples::transform("base_link", "scanner", 3.6)}));
  }

  /// A stationary vehicle, ten scans per second, with a wall at `range` (m) around it. Returns the
  /// last output.
  GridSlamOutput stand(int scans, float range) {
    GridSlamOutput last;
    for (int i = 0; i < scans; ++i, now_ += 0.1) {
      auto scan = samples::laserScan(std::vector<float>(kBeams, range));
      scan.angle_min = static_cast<float>(-M_PI / 2.0);
      scan.angle_increment = static_cast<float>(M_PI / (kBeams - 1));
      scan.header.stamp = ros::Time(now_);
      stage_.handleOdometry(samples::odometry(now_, 0.0));
      const auto output = stage_.handleScan(scan);
      EXPECT_TRUE(output);
      last = output.value_or(last);
    }
    return last;
  }

  TransformBuffer buffer_{1.0};
  StageMonitor monitor_{"grid_slam"};
  GridSlamStageOptions options_;
  GridSlamStage stage_{options_, buffer_, monitor_};
  double now_ = 100.0;  // s
};

TEST_F(GridSlamLocalizationTest, LocatedIsReportedWithoutAReason) {
  const GridSlamOutput output = stand(20, 19.0F);
  ASSERT_TRUE(output.localization && output.pose);
  EXPECT_EQ(output.localization->header.stamp, output.pose->header.stamp);
  EXPECT_EQ(output.localization->header.frame_id, "map");
  EXPECT_EQ(output.localization->state, LocalizationState::LOCATED);
  EXPECT_EQ(output.localization->maps_started, 0U);
  EXPECT_EQ(output.localization->reason, "");
}

TEST_F(GridSlamLocalizationTest, CarriedElsewhereItIsUncertainThenLostThenInANewMap) {
  stand(40, 19.0F);
  const GridSlamOutput suspected = stand(1, 10.0F);
  ASSERT_TRUE(suspected.localization);
  EXPECT_EQ(suspected.localization->state, LocalizationState::UNCERTAIN);
  EXPECT_NE(suspected.localization->reason.find("contradicts"), std::string::npos);
  EXPECT_EQ(monitor_.health(), HealthLevel::kDegraded);
  const GridSlamOutput kidnapped = stand(15, 10.0F);
  ASSERT_TRUE(kidnapped.localization);
  EXPECT_EQ(kidnapped.localization->state, LocalizationState::LOST);
  EXPECT_EQ(kidnapped.localization->maps_started, 0U);
  EXPECT_EQ(monitor_.health(), HealthLevel::kNoOutput);
  EXPECT_NE(kidnapped.localization->reason.find("kidnapped"), std::string::npos);
  const GridSlamOutput found = stand(100, 10.0F);
  ASSERT_TRUE(found.localization);
  EXPECT_EQ(found.localization->state, LocalizationState::LOCATED);
  EXPECT_EQ(found.localization->maps_started, 1U);
  EXPECT_EQ(monitor_.health(), HealthLevel::kOk);
}

}  // namespace
}  // namespace datmo::grid_slam_localization_test
