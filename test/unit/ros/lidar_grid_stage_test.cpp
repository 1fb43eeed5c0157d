// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/lidar_grid_stage.h"

#include <limits>

#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/grid_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::lidar_grid_stage_test {
namespace {

using samples::kStart;

class LidarGridStageTest : public testing::Test {
 protected:
  /// 3.6 m ahead of the vehicle's origin.
  void mountScanner() {
    buffer_.addStatic(samples::transforms({samples::transform("base_link", "scanner", 3.6)}));
  }

  nav_msgs::OccupancyGridPtr scanAt(double seconds) {
    auto scan = samples::laserScan();
    scan.header.stamp = ros::Time(seconds);
    return stage_.handleScan(scan);
  }

  /// The vehicle drives ahead at 8 m/s.
  void odometryAt(double seconds) {
    nav_msgs::Odometry message;
    message.header.stamp = ros::Time(seconds);
    message.header.frame_id = "odom";
    message.child_frame_id = "base_link";
    message.twist.twist.linear.x = 8.0;
    stage_.handleOdometry(message);
  }

  /// Returns whether a point in the vehicle's frame, m, is reported occupied.
  static bool isOccupiedAt(const nav_msgs::OccupancyGrid& message, double x, double y) {
    const SensorGrid grid = fromMessage(message);
    return isOccupied(grid.at(grid.window().cellAt({x, y})));
  }

  TransformBuffer buffer_{1.0};
  StageMonitor monitor_{"lidar_grid"};
  LidarGridStage stage_{LidarGridStageOptions(), buffer_, monitor_};
};

TEST_F(LidarGridStageTest, AScanMakesAGridOfItsStampInTheVehiclesFrame) {
  mountScanner();
  const auto grid = scanAt(kStart);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->header.frame_id, "base_link");
  EXPECT_EQ(grid->header.stamp, ros::Time(kStart));
  EXPECT_EQ(fromMessage(*grid).window(), GridWindowOptions().window());
  EXPECT_TRUE(isOccupiedAt(*grid, 3.6 + 3.0, 0.0)) << "the beam ahead";
  EXPECT_TRUE(isOccupiedAt(*grid, 3.6, -2.0)) << "the one to the right";
  EXPECT_FALSE(isOccupiedAt(*grid, 3.6 + 2.0, 0.0));
  EXPECT_EQ(monitor_.processedCount(), 1U);
  EXPECT_EQ(monitor_.figures().at("beams with a hit"), 3.0);
}

TEST_F(LidarGridStageTest, MultiEchoScansAreAcceptedToo) {
  mountScanner();
  sensor_msgs::MultiEchoLaserScan echoes;
  const auto scan = samples::laserScan();
  echoes.header = scan.header;
  echoes.angle_min = scan.angle_min;
  echoes.angle_max = scan.angle_max;
  echoes.angle_increment = scan.angle_increment;
  echoes.range_min = scan.range_min;
  echoes.range_max = scan.range_max;
  echoes.ranges.resize(3);
  echoes.ranges[1].echoes = {3.0F, 5.0F};
  const auto grid = stage_.handleScan(echoes);
  ASSERT_TRUE(grid);
  EXPECT_TRUE(isOccupiedAt(*grid, 6.6, 0.0));
}

TEST_F(LidarGridStageTest, BeamsAreCompensatedToTheStampOfTheScanByOdometry) {
  mountScanner();
  odometryAt(kStart);
  auto scan = samples::laserScan();
  scan.time_increment = 0.1F;  // the beam ahead is measured 0.8 m further on
  const auto grid = stage_.handleScan(scan);
  ASSERT_TRUE(grid);
  EXPECT_TRUE(isOccupiedAt(*grid, 3.6 + 3.0 + 0.8, 0.0));
}

TEST_F(LidarGridStageTest, WithoutOdometryBeamsAreCompensatedByThePosesOfTheSlam) {
  LidarGridStageOptions options;
  options.motion.source = MotionSource::kNone;
  LidarGridStage stage(options, buffer_, monitor_);
  mountScanner();
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "of nobody";
  stage.handleOdometry(odometry);
  EXPECT_EQ(monitor_.droppedCount(), 0U) << "it is not read";
  auto scan = samples::laserScan();
  scan.time_increment = 0.1F;
  const auto before = stage.handleScan(scan);
  ASSERT_TRUE(before);
  EXPECT_TRUE(isOccupiedAt(*before, 3.6 + 3.0, 0.0)) << "as measured at once";
  for (const double t : {kStart - 0.1, kStart}) {
    geometry_msgs::PoseWithCovarianceStamped pose;
    pose.header.stamp = ros::Time(t);
    pose.pose.pose = toMessage(Pose2(8.0 * t, 5.0, 0.0));
    stage.handlePose(pose);
  }
  scan.header.stamp = ros::Time(kStart + 0.1);
  const auto grid = stage.handleScan(scan);
  ASSERT_TRUE(grid);
  EXPECT_TRUE(isOccupiedAt(*grid, 3.6 + 3.0 + 0.8, 0.0)) << "measured 0.8 m further on";
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(LidarGridStageTest, AJumpBackStartsOverWhicheverInputSeesItFirst) {
  mountScanner();
  odometryAt(200.0);
  EXPECT_TRUE(scanAt(200.0));
  EXPECT_TRUE(scanAt(150.0));
  odometryAt(150.01);
  EXPECT_TRUE(scanAt(150.1));
  odometryAt(100.0);
  EXPECT_TRUE(scanAt(149.9)) << "older than the last scan by less than a restart, but all is new";
  EXPECT_EQ(samples::warnings(monitor_, "clock_restart"), 2U) << "once for both inputs";
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(LidarGridStageTest, AScanWithoutAValidBeamIsUninformative) {
  mountScanner();
  const auto grid = stage_.handleScan(
      samples::laserScan(std::vector<float>(3, std::numeric_limits<float>::quiet_NaN())));
  ASSERT_TRUE(grid);
  EXPECT_EQ(std::count(grid->data.begin(), grid->data.end(), kUnknownPercent),
            static_cast<std::ptrdiff_t>(grid->data.size()));
  EXPECT_EQ(samples::warnings(monitor_, "no_valid_beam"), 1U);
}

TEST_F(LidarGridStageTest, BadOptionsAreRefused) {
  LidarGridStageOptions options;
  options.grid.window.cell_size = -1.0;
  EXPECT_THROW(LidarGridStage(options, buffer_, monitor_), OptionError);
}

}  // namespace
}  // namespace datmo::lidar_grid_stage_test
