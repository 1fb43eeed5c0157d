// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/map_fusion_stage.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>

#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>
#include <unistd.h>

#include "datmo_fusion/ros/convert/grid_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/map_files.h"

namespace datmo::map_fusion_stage_test {
namespace {

constexpr Percent kOccupied = 80;
constexpr Percent kFree = 20;

/// 20 x 10 cells of 1 m about the vehicle.
const GridWindow kWindow{1.0, 20, 10, {-10, -5}};
const CellIndex kCell{3, 1};

nav_msgs::OccupancyGrid gridMessage(double seconds, Percent percent,
                                    const GridWindow& window = kWindow) {
  SensorGrid grid(Stamp::fromSeconds(seconds), window);
  std::fill(grid.cells().begin(), grid.cells().end(), kFree);
  grid.at(kCell) = percent;
  return toMessage(grid, "base_link");
}

LabeledScanMessage scanMessage(double seconds, const Pose2& pose = Pose2(),
                               const std::string& map_frame = "map", double variance = 1e-4) {
  LabeledScan scan;
  scan.stamp = Stamp::fromSeconds(seconds);
  scan.base_in_map.pose = pose;
  scan.base_in_map.covariance = variance * Eigen::Matrix3d::Identity();
  return toMessage(scan, "base_link", map_frame);
}

Percent percentAt(const nav_msgs::OccupancyGrid& message, CellIndex cell) {
  return fromMessage(message).atOrUnknown(cell);
}

class MapFusionStageTest : public testing::Test {
 protected:
  MapFusionStageTest() {
    options_.fuser.map.free_probability = 0.2;  // a free cell is as informative as a hit
    options_.fuser.sources["lidar"].reliability = 0.8;
    options_.fuser.sources["stereo"].reliability = 0.9;
    start();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void start() { stage_ = std::make_unique<MapFusionStage>(options_, monitor_); }

  void handle(const std::string& source, const nav_msgs::OccupancyGrid& grid) {
    stage_->handleGrid(source, grid, toStamp(grid.header.stamp));
  }
  void handle(const LabeledScanMessage& scan) {
    stage_->handleLabeledScan(scan, toStamp(scan.header.stamp));
  }

  std::optional<MapFusionOutput> nextAt(double seconds) {
    return stage_->next(Stamp::fromSeconds(seconds));
  }

  /// Adds both sources and the pose at this time.
  std::optional<MapFusionOutput> allAt(double seconds, Percent lidar, Percent stereo,
                                       const Pose2& pose = Pose2(), double variance = 1e-4) {
    handle("lidar", gridMessage(seconds, lidar));
    handle("stereo", gridMessage(seconds, stereo));
    handle(scanMessage(seconds, pose, "map", variance));
    return nextAt(seconds);
  }

  /// A map of free cells with one occupied cell; returns its name.
  std::string priorMap(CellIndex occupied, double cell_size) {
    std::filesystem::create_directories(folder_);
    OccupancyMapOptions options;
    options.window = {20.0, 10.0, cell_size};
    MapEvidence evidence{cell_size, {}};
    for (int row = -5; row < 5; ++row) {
      for (int column = -10; column < 10; ++column) {
        const CellIndex cell{column, row};
        evidence.cells.push_back({cell, cell == occupied ? 3.0F : -3.0F, 0.0F, 0, 0, {}});
      }
    }
    const std::string file = (folder_ / "prior.map").string();
    writeMap(file, OccupancyMap::restored(options, evidence));
    return file;
  }

  std::uint64_t drops(const std::string& reason) const { return samples::drops(monitor_, reason); }
  std::uint64_t warnings(const std::string& reason) const {
    return samples::warnings(monitor_, reason);
  }

  StageMonitor monitor_{"map_fusion"};
  MapFusionStageOptions options_;
  std::unique_ptr<MapFusionStage> stage_;
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() /
                                  ("map_fusion_stage_test_" + std::to_string(getpid()));
};

TEST_F(MapFusionStageTest, GridsWaitForThePoseOfTheirStamp) {
  handle("lidar", gridMessage(100.0, kOccupied));
  handle("stereo", gridMessage(100.0, kFree));
  EXPECT_FALSE(nextAt(100.0));
  handle(scanMessage(100.0, Pose2(5.0, 0.0, 0.0)));
  const auto output = nextAt(100.0);
  ASSERT_TRUE(output && output->fused);
  EXPECT_EQ(output->fused->header.frame_id, "map");
  EXPECT_EQ(output->fused->header.stamp, ros::Time(100.0));
  EXPECT_EQ(output->fused->info.origin.position.x, -5.0) << "about the vehicle";
  EXPECT_LT(percentAt(*output->fused, {8, 1}), kUndecidedPercent) << "stereo is believed more";
  EXPECT_EQ(output->conflicts->header.frame_id, "map");
  EXPECT_EQ(percentAt(*output->conflicts, {8, 1}), 26) << "0.6 x 0.6 x 0.8 x 0.9";
  EXPECT_EQ(monitor_.figures().at("cells in conflict"), 1.0);
  EXPECT_EQ(output->changes, nullptr);
  EXPECT_EQ(monitor_.droppedCount() + monitor_.warningCount(), 0U);
}

TEST_F(MapFusionStageTest, AllGridsAreUsedAndMapsPublishedOncePerPeriod) {
  EXPECT_TRUE(allAt(100.0, kOccupied, kOccupied)->fused);
  for (int i = 1; i < 10; ++i) {
    const auto output = allAt(100.0 + 0.1 * i, kOccupied, kOccupied);
    ASSERT_TRUE(output);
    EXPECT_FALSE(output->fused);
  }
  const auto output = allAt(101.0, kOccupied, kOccupied);
  ASSERT_TRUE(output && output->fused);
  EXPECT_GT(percentAt(*output->fused, kCell), 97);
  EXPECT_EQ(monitor_.processedCount(), 11U);
}

TEST_F(MapFusionStageTest, AGridIsPlacedAtTheVehiclesPoseOfItsStamp) {
  for (int i = 0; i <= 10; ++i) {
    stage_->handleOdometry(samples::odometry(100.0 + 0.02 * i, 20.0));
  }
  handle("stereo", gridMessage(100.15, kOccupied));
  handle("lidar", gridMessage(100.2, kFree));
  handle(scanMessage(100.2, Pose2(4.0, 0.0, 0.0)));
  EXPECT_FALSE(nextAt(100.25)) << "the camera may have a nearer one";
  const auto output = nextAt(100.31);
  ASSERT_TRUE(output && output->fused);
  // 50 ms before it was 1 m behind: cell 3 + 4 - 1.
  EXPECT_GT(percentAt(*output->conflicts, {6, 1}), 0);
  EXPECT_EQ(percentAt(*output->conflicts, {7, 1}), 0);
}

TEST_F(MapFusionStageTest, ASilentSourceStaysInTheMap) {
  allAt(100.0, kOccupied, kOccupied);
  std::optional<MapFusionOutput> output;
  for (int i = 1; i <= 20; ++i) {
    const double t = 100.0 + 0.1 * i;
    handle("lidar", gridMessage(t, kOccupied));
    handle(scanMessage(t));
    for (auto next = nextAt(t); next; next = nextAt(t)) {
      output = next->fused ? next : output;
    }
  }
  ASSERT_TRUE(output && output->fused);
  EXPECT_EQ(percentAt(*output->conflicts, kCell), 0) << "both know it";
  EXPECT_EQ(warnings("silent_source"), 1U);
  EXPECT_GT(monitor_.figures().at("fused without stereo"), 5.0);
}

TEST_F(MapFusionStageTest, WithoutPosesNothingIsPublishedAndItIsReported) {
  for (int i = 0; i < 20; ++i) {
    const double t = 100.0 + 0.1 * i;
    handle("lidar", gridMessage(t, kOccupied));
    handle("stereo", gridMessage(t, kOccupied));
    while (const auto output = nextAt(t)) {
      EXPECT_FALSE(output->fused);
    }
  }
  EXPECT_GT(monitor_.figures().at("fused without labeled_scan"), 5.0);
  EXPECT_EQ(warnings("silent_source"), 1U);
  EXPECT_EQ(monitor_.processedCount(), 0U);
}

TEST_F(MapFusionStageTest, InvalidGridsAreRefusedAndCounted) {
  allAt(100.0, kFree, kFree);
  handle("stereo", gridMessage(100.1, kFree, {0.5, 20, 10, {-10, -5}}));
  EXPECT_EQ(drops("wrong_window"), 1U);
  EXPECT_EQ(
      monitor_.lastError(),
      "grid of stereo of 20 x 10 cells of 0.5 m from cell (-10, -5): expected 20 x 10 cells of "
      "1 m from cell (-10, -5), as in the first grid");
  handle("stereo", gridMessage(100.15, kFree, {1.0, 30, 10, {-15, -5}}));
  EXPECT_EQ(drops("wrong_window"), 2U) << "of another size";
  auto elsewhere = gridMessage(100.2, kFree);
  elsewhere.header.frame_id = "camera";
  handle("stereo", elsewhere);
  EXPECT_EQ(drops("wrong_frame"), 1U);
  auto no_number = gridMessage(100.2, kFree);
  no_number.info.resolution = std::numeric_limits<float>::quiet_NaN();
  handle("stereo", no_number);
  EXPECT_EQ(drops("bad_grid"), 1U);
  handle("stereo", gridMessage(99.9, kFree));
  EXPECT_EQ(drops("old_stamp"), 1U);
  handle("radar", gridMessage(100.2, kFree));
  EXPECT_EQ(drops("unknown_source"), 1U);
  handle(scanMessage(100.2, Pose2(), "other_map"));
  EXPECT_EQ(drops("wrong_frame"), 2U);
  LabeledScanMessage unsure = scanMessage(100.2);
  unsure.pose.covariance[0] = std::numeric_limits<double>::quiet_NaN();
  handle(unsure);
  EXPECT_EQ(drops("bad_pose"), 1U);
  EXPECT_EQ(monitor_.droppedCount(), 8U);
  EXPECT_TRUE(allAt(101.0, kFree, kFree)->fused) << "it goes on";
}

TEST_F(MapFusionStageTest, AClockJumpBackStartsOver) {
  allAt(100.0, kOccupied, kOccupied);
  const auto output = allAt(50.0, kFree, kFree);
  ASSERT_TRUE(output && output->fused);
  EXPECT_LT(percentAt(*output->fused, kCell), kFree);
  EXPECT_EQ(warnings("clock_restart"), 1U);
}

TEST_F(MapFusionStageTest, APoseJumpAgainstTheMotionStartsOver) {
  for (int i = 0; i <= 20; ++i) {
    stage_->handleOdometry(samples::odometry(100.0 + 0.02 * i, 20.0));
  }
  allAt(100.0, kOccupied, kOccupied);
  allAt(100.1, kOccupied, kOccupied, Pose2(2.0, 0.0, 0.0));
  allAt(100.2, kOccupied, kOccupied, Pose2(12.0, 0.0, 0.0));
  ASSERT_TRUE(allAt(101.0, kFree, kFree, Pose2(14.0, 0.0, 0.0))->fused);
  EXPECT_EQ(monitor_.figures().at("maps started over"), 1.0);
}

TEST_F(MapFusionStageTest, ABrieflyUncertainPoseLeavesTheMapsUnchanged) {
  constexpr double kUncertain = 1e4;
  allAt(100.0, kOccupied, kOccupied);
  for (int i = 1; i < 10; ++i) {
    EXPECT_TRUE(allAt(100.0 + 0.1 * i, kFree, kFree, Pose2(), kUncertain));
  }
  const auto output = allAt(101.0, kOccupied, kOccupied);
  ASSERT_TRUE(output && output->fused);
  EXPECT_GT(percentAt(*output->fused, kCell), 80) << "nothing was taken";
  EXPECT_EQ(monitor_.figures().at("scans left out because of an uncertain pose"), 9.0);
  for (int i = 1; i <= 82; ++i) {
    allAt(101.0 + 0.1 * i, kFree, kFree, Pose2(), kUncertain);
  }
  EXPECT_EQ(monitor_.figures().at("maps started over"), 1.0) << "it is in a new map";
}

TEST_F(MapFusionStageTest, GridsWithoutAPoseAreCounted) {
  for (int i = 0; i < 3; ++i) {  // a camera that is three times as fast
    handle("stereo", gridMessage(100.0 + 0.03 * i, kFree));
  }
  handle("lidar", gridMessage(100.06, kFree));
  handle(scanMessage(100.06));
  ASSERT_TRUE(nextAt(100.06));
  EXPECT_EQ(monitor_.figures().at("lists of stereo not fused"), 2.0);
}

TEST_F(MapFusionStageTest, ChangesSinceThePriorMapArePublished) {
  options_.prior_map = priorMap({-4, 1}, 1.0);
  start();
  const auto output = allAt(100.0, kOccupied, kOccupied);
  ASSERT_TRUE(output && output->changes);
  EXPECT_EQ(output->changes->header.frame_id, "map");
  EXPECT_EQ(percentAt(*output->changes, kCell), kNewPercent);
  EXPECT_EQ(percentAt(*output->changes, {-4, 1}), kVanishedPercent);
  EXPECT_EQ(percentAt(*output->changes, {0, 0}), kUnknownPercent);
  EXPECT_EQ(monitor_.figures().at("cells new since the prior map"), 1.0);
  EXPECT_EQ(monitor_.figures().at("cells vanished since the prior map"), 1.0);
  EXPECT_TRUE(allAt(50.0, kFree, kFree)->changes) << "it outlives a restart";
}

TEST_F(MapFusionStageTest, WithoutTheCompletePriorMapItContinues) {
  options_.prior_map = priorMap(kCell, 0.5);
  start();
  const auto output = allAt(100.0, kOccupied, kOccupied);
  ASSERT_TRUE(output && output->fused);
  EXPECT_EQ(output->changes, nullptr);
  EXPECT_EQ(warnings("bad_prior_map"), 1U);
  EXPECT_NE(monitor_.lastError().find("cells of 0.5 m, expected 1 m"), std::string::npos);
  EXPECT_EQ(monitor_.health(), HealthLevel::kDegraded);
  options_.prior_map = "/nowhere/prior.map";
  start();
  EXPECT_TRUE(allAt(100.0, kOccupied, kOccupied)->fused);
  EXPECT_EQ(warnings("bad_prior_map"), 2U);
}

TEST_F(MapFusionStageTest, ASourceMustNotHaveAReservedName) {
  options_.fuser.sources["fused"];
  EXPECT_THROW(start(), OptionError);
}

}  // namespace
}  // namespace datmo::map_fusion_stage_test
