// SPDX-License-Identifier: BSD-3-Clause
// The service save_map of the stage grid_slam.
#include <filesystem>

#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>
#include <unistd.h>

#include "datmo_fusion/ros/map_files.h"
#include "datmo_fusion/ros/stage/grid_slam_stage.h"

namespace datmo::save_map_test {
namespace {

class SaveMapTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("save_map_test_" + std::to_string(getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    buffer_.addStatic(samples::transforms({samples::transform("base_link", "scanner", 3.6)}));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// Returns the answer of a stage that has processed some scans.
  datmo_fusion::SaveMap::Response answer(const std::string& name,
                                         const std::string& prior_map = "") {
    GridSlamStageOptions options;
    options.prior_map.file = prior_map;
    GridSlamStage stage(options, buffer_, monitor_);
    for (int i = 0; i < 5; ++i) {
      auto scan = samples::laserScan();
      scan.header.stamp = ros::Time(100.0 + 0.1 * i);
      stage.handleScan(scan);
    }
    datmo_fusion::SaveMap::Request request;
    request.file = name;
    return stage.answer(request);
  }

  TransformBuffer buffer_{1.0};
  StageMonitor monitor_{"grid_slam"};

 private:
  std::filesystem::path folder_;
};

TEST_F(SaveMapTest, TheMapIsWrittenAndCanBeReadAgain) {
  const auto response = answer(file("hall.map"));
  EXPECT_TRUE(response.success) << response.message;
  EXPECT_FALSE(readMap(file("hall.map"), GridSlamStageOptions().slam.map).evidence().cells.empty());
}

/// After a drive of 40 m with very little space for the map, in memory and in a file in this
/// folder.
TEST_F(SaveMapTest, ThereIsAWarningOfForgottenTiles) {
  const auto answerAfterDrive = [this](const std::string& folder) {
    GridSlamStageOptions options;
    options.slam.map.window = {20.0, 20.0, 0.2};
    options.slam.map.max_tiles = 1;
    options.slam.map.tile_file.folder = folder;
    GridSlamStage stage(options, buffer_, monitor_);
    for (double seconds = 100.0; seconds < 105.0; seconds += 0.1) {
      stage.handleOdometry(samples::odometry(seconds, 8.0));
      auto scan = samples::laserScan();
      scan.header.stamp = ros::Time(seconds);
      stage.handleScan(scan);
      stage.mapIfDue(Stamp::fromSeconds(seconds));
    }
    datmo_fusion::SaveMap::Request request;
    request.file = file("street.map");
    return stage.answer(request).message;
  };
  EXPECT_EQ(answerAfterDrive(file("")).find("missing"), std::string::npos);
  EXPECT_EQ(samples::warnings(monitor_, "forgotten_tile"), 0U);
  EXPECT_NE(answerAfterDrive("").find("tile_file/folder is empty"), std::string::npos);
  EXPECT_GE(samples::warnings(monitor_, "forgotten_tile"), 1U);
}

TEST_F(SaveMapTest, ARelativePathIsRefused) {
  const auto response = answer("hall.map");
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("expected an absolute path"), std::string::npos);
}

TEST_F(SaveMapTest, WriteErrorsAreReportedAndCounted) {
  const auto response = answer(file("none/hall.map"));
  EXPECT_FALSE(response.success);
  EXPECT_EQ(samples::warnings(monitor_, "map_not_saved"), 1U);
}

TEST_F(SaveMapTest, TheMapInUseIsNotReplaced) {
  ASSERT_TRUE(answer(file("hall.map")).success);
  const auto response = answer(file("hall.v2"), file("hall.map"));
  EXPECT_FALSE(response.success) << "both have hall.yaml";
  EXPECT_NE(response.message.find("the map in use"), std::string::npos) << response.message;
  EXPECT_TRUE(answer(file("hall2.map"), file("hall.map")).success);
}

}  // namespace
}  // namespace datmo::save_map_test
