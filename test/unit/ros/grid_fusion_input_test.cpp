// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <limits>

#include "grid_fusion_sample.h"
#include <gtest/gtest.h>

namespace datmo::grid_fusion_input_test {
namespace {

using namespace grid_fusion_samples;

TEST_F(GridFusionStageTest, AStampFarAheadOfTheReferenceIsDropped) {
  const auto handle_at = [this](const std::string& source, double stamp, double now) {
    stage_.handleGrid(source, message(stamp, kFree), Stamp::fromSeconds(now));
  };
  for (int i = 0; i < 20; ++i) {
    const double t = 100.0 + 0.1 * i;
    handle_at("lidar", t, t);
    handle_at("stereo", t + 0.7, t);
    const auto output = nextAt(t + 0.11);
    ASSERT_TRUE(output) << t;
    EXPECT_EQ(output->fused->header.stamp, ros::Time(t)) << "the lidar's";
  }
  EXPECT_EQ(drops("stamp_ahead"), 20U);
  handle_at("lidar", 102.0, 102.0);
  handle_at("stereo", 103.0, 102.0);
  EXPECT_EQ(drops("stamp_ahead"), 21U);
  EXPECT_NE(monitor_.lastError().find("102.0"), std::string::npos) << "the lidar's stamp";
  EXPECT_NE(monitor_.lastError().find("103.0"), std::string::npos) << "stereo's";
  handle_at("stereo", 102.8, 102.8);
  handle_at("stereo", 110.0, 103.5);
  EXPECT_EQ(drops("stamp_ahead"), 21U) << "the lidar has fallen silent";
}

TEST_F(GridFusionStageTest, GridsOfAnotherWindowAreRefusedWithBothSizes) {
  handle("lidar", 100.0, kFree);
  handle("stereo", message(100.0, kFree, {0.5, 20, 4, {0, -2}}));
  EXPECT_EQ(drops("wrong_window"), 1U);
  EXPECT_NE(monitor_.lastError().find("20 x 4 cells of 0.5 m"), std::string::npos);
  EXPECT_NE(monitor_.lastError().find("10 x 2 cells of 1 m"), std::string::npos);
  EXPECT_TRUE(nextAt(100.2)) << "the lidar goes on";
  EXPECT_TRUE(bothAt(100.3, kFree, kFree)) << "and so does stereo with the right window";
}

TEST_F(GridFusionStageTest, BadGridsAreDroppedAndCounted) {
  nav_msgs::OccupancyGrid grid = message(100.0, kFree);
  grid.header.frame_id = "map";
  handle("lidar", grid);
  EXPECT_EQ(drops("wrong_frame"), 1U);
  grid = message(100.0, kFree);
  grid.data.pop_back();
  handle("lidar", grid);
  EXPECT_EQ(drops("bad_grid"), 1U);
  handle("radar", 100.0, kFree);
  EXPECT_EQ(drops("unknown_source"), 1U);
  handle("lidar", 0.0, kFree);
  EXPECT_EQ(drops("zero_stamp"), 1U);
  handle("lidar", 100.0, kFree);
  handle("lidar", 100.0, kFree);
  EXPECT_EQ(drops("repeated_stamp"), 1U);
  handle("lidar", 99.9, kFree);
  EXPECT_EQ(drops("old_stamp"), 1U);
  EXPECT_TRUE(nextAt(100.2));
}

TEST_F(GridFusionStageTest, BadMotionIsDroppedAndCounted) {
  nav_msgs::Odometry bad = odometry(100.0);
  bad.twist.twist.linear.x = std::numeric_limits<double>::quiet_NaN();
  stage_.handleOdometry(bad);
  EXPECT_EQ(drops("bad_odometry"), 1U);
  bad = odometry(100.0);
  bad.child_frame_id = "trailer";
  stage_.handleOdometry(bad);
  EXPECT_EQ(drops("wrong_frame"), 1U);
}

TEST_F(GridFusionStageTest, BadOptionsAreRefused) {
  const auto refused = [this](const std::function<void(GridFusionStageOptions&)>& spoil) {
    GridFusionStageOptions options;
    spoil(options);
    EXPECT_THROW(GridFusionStage(options, monitor_), OptionError);
  };
  refused([](auto& options) { options.matcher.reference = "radar"; });
  refused([](auto& options) { options.fuser.sources["lidar"].use = false; });
  for (const char* const name : {"fused", "conflict", "", "2nd", "rear-lidar", "a b"}) {
    refused([&](auto& options) { options.fuser.sources[name].use = true; });
  }
}

}  // namespace
}  // namespace datmo::grid_fusion_input_test
