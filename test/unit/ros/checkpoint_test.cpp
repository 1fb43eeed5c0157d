// SPDX-License-Identifier: BSD-3-Clause
// Checkpoints of the SLAM: their file, when they are used, and the stage that continues from them.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <thread>

#include "../slam/yard.h"
#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>
#include <unistd.h>

#include "datmo_fusion/ros/checkpoint_file.h"
#include "datmo_fusion/ros/stage/grid_slam_stage.h"

namespace datmo::checkpoint_test {
namespace {

constexpr std::size_t kMaxCells = 1'000'000;

std::string contentOf(const std::string& file) {
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  return content.str();
}

void writeContent(const std::string& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content;
}

/// A vehicle in the yard, whose stage runs live, and is unloaded or killed.
class CheckpointTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("checkpoint_test_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    buffer_.addStatic(samples::transforms({samples::transform("base_link", "scanner", 1.0)}));
    options_.checkpoint.file = file();
    options_.checkpoint.run = "run 1";
    load();
  }
  void TearDown() override {
    unload();
    std::filesystem::remove_all(folder_);
  }

  std::string file(const std::string& name = "grid_slam.checkpoint") const {
    return (folder_ / name).string();
  }

  void load(const StepClock& clock = [] { return 0.0; }) {
    monitor_ = std::make_unique<StageMonitor>("grid_slam");
    stage_ = std::make_unique<GridSlamStage>(options_, buffer_, *monitor_, clock);
  }

  void unload() { stage_.reset(); }

  /// Without the last checkpoint of a stage that is unloaded.
  void kill() {
    waitForCheckpoint();
    const std::string map = contentOf(file());
    const std::string pose = contentOf(file() + ".pose");
    unload();
    writeContent(file(), map);
    writeContent(file() + ".pose", pose);
  }

  /// Until that of the last scan is written.
  void waitForCheckpoint() {
    for (int i = 0; i < 1000; ++i) {
      if (std::filesystem::exists(file()) &&
          readCheckpoint(file(), kMaxCells).slam.pose.stamp == toStamp(last_scan_)) {
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      stage_->keepCheckpoint();
    }
    FAIL() << "no checkpoint of the last scan";
  }

  void go(double seconds) {
    pose_ = pose_ * arc(twist_, seconds);
    now_ += seconds;
  }

  /// Returns the output of the last scan.
  GridSlamOutput drive(int scans) {
    GridSlamOutput last;
    for (int i = 0; i < scans; ++i, go(0.1)) {
      nav_msgs::Odometry odometry = samples::odometry(now_, twist_.forward_speed);
      odometry.twist.twist.angular.z = twist_.yaw_rate;
      stage_->takeOdometry(odometry);
      const sensor_msgs::LaserScan seen = scan();
      last_scan_ = seen.header.stamp;
      const auto output = stage_->takeScan(seen);
      EXPECT_TRUE(output);
      stage_->keepCheckpoint();
      last = output.value_or(last);
      truth_ = pose_;
    }
    return last;
  }

  void driveAndUnload() {
    drive(35);
    unload();
  }

  sensor_msgs::LaserScan scan() const {
    const Box2 container{Pose2(33.0, -2.0, 0.4), 5.0, 2.4};
    const Scan seen = Yard().scan(pose_, now_, &container);
    std::vector<float> ranges;
    for (const Ray& ray : seen.rays) {
      ranges.push_back(static_cast<float>(ray.range));
    }
    sensor_msgs::LaserScan scan = samples::laserScan(ranges);
    scan.header.stamp = ros::Time(now_);
    scan.angle_min = static_cast<float>(seen.field.first_bearing);
    scan.angle_increment = static_cast<float>(seen.field.beam_spacing);
    scan.angle_max = -scan.angle_min;
    scan.range_max = 60.0F;
    return scan;
  }

  /// Of the pose in the map that began at the first scan, m.
  double errorOf(const GridSlamOutput& output) const {
    const auto& position = output.pose->pose.pose.position;
    return (Point2(position.x, position.y) - truth_.position()).norm();
  }

  /// Whether the stage that is loaded now starts at the origin of a new map.
  bool startsAnew() {
    const auto& position = drive(1).pose->pose.pose.position;
    return Point2(position.x, position.y).norm() < 1e-9;
  }

  /// Loads the stage, which begins a new map and says why.
  void expectNewMap(const std::string& why) {
    load();
    EXPECT_TRUE(startsAnew());
    std::string announced;
    for (const std::string& text : monitor_->takeAnnouncements()) {
      announced += text + "\n";
    }
    EXPECT_NE(announced.find(why), std::string::npos) << announced;
  }

  GridSlamStageOptions options_;
  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<GridSlamStage> stage_;
  double now_ = 100.0;  // s
  Twist2 twist_{2.0, 0.1};

 private:
  std::filesystem::path folder_;
  TransformBuffer buffer_{1.0};
  ros::Time last_scan_;
  Pose2 pose_;
  Pose2 truth_;
};

TEST_F(CheckpointTest, KilledAtRestItIsFoundInItsMap) {
  drive(35);
  twist_ = {};
  drive(20);
  kill();
  go(1.5);
  load();
  const GridSlamOutput first = drive(1);
  EXPECT_EQ(first.localization->state, LocalizationState::UNCERTAIN);
  EXPECT_NEAR(monitor_->figures().at("age of the checkpoint at the start [s]"), 1.6, 1e-6);
  const GridSlamOutput last = drive(40);
  EXPECT_EQ(last.localization->state, LocalizationState::LOCATED);
  EXPECT_EQ(last.localization->maps_started, 0U);
  EXPECT_LT(errorOf(last), 0.15);
}

TEST_F(CheckpointTest, KilledWhileDrivingItSoonContinuesInTheSameFrame) {
  drive(35);
  kill();
  go(1.5);
  load();
  EXPECT_EQ(drive(1).localization->state, LocalizationState::UNCERTAIN);
  const GridSlamOutput last = drive(10);
  EXPECT_EQ(last.localization->state, LocalizationState::LOCATED);
  EXPECT_EQ(last.localization->maps_started, 1U);
  EXPECT_LT(errorOf(last), 0.5);
}

TEST_F(CheckpointTest, UnloadedItContinuesWithoutASearch) {
  driveAndUnload();
  go(0.2);
  load();
  const GridSlamOutput first = drive(1);
  EXPECT_EQ(first.localization->state, LocalizationState::LOCATED);
  EXPECT_LT(errorOf(first), 0.15);
  EXPECT_NE(monitor_->healthReason().find("continues from a checkpoint of 0.3 s"),
            std::string::npos);
}

TEST_F(CheckpointTest, WhatIsWrittenIsRead) {
  driveAndUnload();
  const Checkpoint read = readCheckpoint(file(), kMaxCells);
  EXPECT_EQ(read.run, "run 1");
  EXPECT_EQ(read.options.at("map/cell_size"), "0.3");
  EXPECT_EQ(read.slam.pose.odometry.size(), 1U);
  const std::string again = file("again");
  writeCheckpoint(again, read);
  EXPECT_EQ(contentOf(again), contentOf(file()));
}

TEST_F(CheckpointTest, APoseOfAnotherMapIsIgnored) {
  driveAndUnload();
  Checkpoint read = readCheckpoint(file(), kMaxCells);
  const Pose2 pose = read.slam.pose.estimate.pose;
  read.slam.pose.estimate.pose = Pose2(50.0, 0.0, 0.0);
  const std::uint32_t id = writeCheckpoint(file("again"), readCheckpoint(file(), kMaxCells));
  writePose(file(), id + 1, read.slam);
  EXPECT_EQ(readCheckpoint(file(), kMaxCells).slam.pose.estimate.pose.position(), pose.position());
  writePose(file(), id, read.slam);
  EXPECT_EQ(readCheckpoint(file(), kMaxCells).slam.pose.estimate.pose.x(), 50.0);
}

TEST_F(CheckpointTest, AnotherStartOfTheStackBeginsANewMap) {
  driveAndUnload();
  options_.checkpoint.run = "run 2";
  load();
  EXPECT_TRUE(startsAnew());
}

TEST_F(CheckpointTest, AnOldCheckpointIsIgnored) {
  driveAndUnload();
  go(12.0);
  expectNewMap("12.1 s older than the first scan, expected more than 0 and at most 10 s");
}

TEST_F(CheckpointTest, ABagThatStartsAgainBeginsANewMap) {
  driveAndUnload();
  now_ -= 3.0;
  expectNewMap("-2.9 s older");
}

TEST_F(CheckpointTest, AfterAJumpOfTheClockThereIsNoWayBack) {
  driveAndUnload();
  load();
  drive(1);
  now_ -= 50.0;
  EXPECT_TRUE(startsAnew());
  EXPECT_FALSE(std::filesystem::exists(file())) << "by the new clock, it may look recent";
}

TEST_F(CheckpointTest, AnotherConfigurationBeginsANewMap) {
  driveAndUnload();
  options_.slam.map.window.cell_size = 0.2;
  expectNewMap("map/cell_size was 0.3, expected 0.2");
}

TEST_F(CheckpointTest, ADamagedFileIsOneWarningAndANewMap) {
  driveAndUnload();
  const std::string whole = contentOf(file());
  std::vector<std::string> damaged{"", "something else", std::string(10'000'000, 'x')};
  for (const double share : {0.0001, 0.001, 0.01, 0.5, 0.99}) {
    const auto length = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
    damaged.push_back(whole.substr(0, length));
    damaged.push_back(whole);
    damaged.back()[length] ^= 0x20;
  }
  for (const std::string& content : damaged) {
    writeContent(file(), content);
    load();
    EXPECT_EQ(samples::warnings(*monitor_, "bad_checkpoint"), 1U) << content.substr(0, 60);
    EXPECT_TRUE(startsAnew());
    unload();
  }
}

TEST_F(CheckpointTest, AFolderThatCannotBeWrittenIsOnlyAWarning) {
  options_.checkpoint.file = file("none/grid_slam.checkpoint");
  load();
  for (int i = 0; i < 200 && samples::warnings(*monitor_, "checkpoint_not_written") == 0; ++i) {
    drive(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_GE(samples::warnings(*monitor_, "checkpoint_not_written"), 1U);
}

TEST_F(CheckpointTest, OnABagNothingIsWrittenOrRead) {
  driveAndUnload();
  const std::string before = contentOf(file());
  load({});
  EXPECT_TRUE(startsAnew());
  drive(30);
  unload();
  EXPECT_EQ(contentOf(file()), before);
}

}  // namespace
}  // namespace datmo::checkpoint_test
