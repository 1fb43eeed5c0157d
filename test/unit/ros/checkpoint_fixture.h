// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>

#include "../slam/yard.h"
#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>
#include <unistd.h>

#include "datmo_fusion/ros/checkpoint_file.h"
#include "datmo_fusion/ros/stage/grid_slam_stage.h"

namespace datmo::checkpoint_test {
inline constexpr std::size_t kMaxCells = 1'000'000;

inline std::string contentOf(const std::string& file) {
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  return content.str();
}

inline void writeContent(const std::string& file, const std::string& content) {
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
      stage_->handleOdometry(odometry);
      const sensor_msgs::LaserScan seen = scan();
      last_scan_ = seen.header.stamp;
      const auto output = stage_->handleScan(seen);
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
    for (const std::string& text : monitor_->handleAnnouncements()) {
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

}  // namespace datmo::checkpoint_test
