// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/grid_slam_stage.h"

#include <limits>

#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/frames.h"

namespace datmo::grid_slam_stage_test {
namespace {

nav_msgs::Odometry odometry(double seconds) { return samples::odometry(seconds, 8.0); }

class GridSlamStageTest : public testing::Test {
 protected:
  void mountScanner() {
    buffer_.addStatic(samples::transforms({samples::transform("base_link", "scanner", 3.6)}));
  }

  /// Enough beams to recognize it.
  static sensor_msgs::LaserScan scanOfAWall() {
    auto scan = samples::laserScan(std::vector<float>(21, 12.0F));
    scan.angle_increment = static_cast<float>(M_PI / 20.0);
    return scan;
  }

  std::optional<GridSlamOutput> scanAt(double seconds) {
    auto scan = samples::laserScan();
    scan.header.stamp = ros::Time(seconds);
    return stage_.handleScan(scan);
  }

  nav_msgs::OccupancyGridPtr mapAfterScanAt(double seconds) {
    scanAt(seconds);
    return stage_.mapIfDue(Stamp::fromSeconds(seconds));
  }

  /// The vehicle drives ahead at 8 m/s; it is at x = 0 at the start.
  void odometryAt(double seconds) { stage_.handleOdometry(odometry(seconds)); }

  std::uint64_t drops(const std::string& reason) const { return samples::drops(monitor_, reason); }

  std::uint64_t warnings(const std::string& reason) const {
    return samples::warnings(monitor_, reason);
  }

  TransformBuffer buffer_{1.0};
  StageMonitor monitor_{"grid_slam"};
  GridSlamStageOptions options_;
  GridSlamStage stage_{options_, buffer_, monitor_};
};

TEST_F(GridSlamStageTest, AScanMakesAllOutputs) {
  mountScanner();
  odometryAt(100.0);
  const auto output = scanAt(100.0);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->labeled_scan->header.frame_id, "base_link");
  EXPECT_EQ(output->labeled_scan->points.size(), 3U);
  EXPECT_EQ(output->pose->header.frame_id, "map");
  EXPECT_EQ(output->pose->header.stamp, ros::Time(100.0));
  ASSERT_EQ(output->transforms.size(), 1U);
  EXPECT_EQ(monitor_.processedCount(), 1U);
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(GridSlamStageTest, MapToOdomTimesOdomToBaseIsThePose) {
  mountScanner();
  odometryAt(100.0);
  scanAt(100.0);
  odometryAt(100.05);
  const auto output = scanAt(100.06);
  ASSERT_TRUE(output);
  buffer_.add(samples::transforms(output->transforms));
  buffer_.add(samples::transforms({samples::transform("odom", "base_link", 8.0 * 0.06, 100.06)}));
  const Pose2 through_tf = planarPose(buffer_.core(), "map", "base_link", ros::Time(100.06));
  const Pose2 pose = fromMessage(output->pose->pose.pose);
  EXPECT_NEAR((through_tf.position() - pose.position()).norm(), 0.0, 1e-6);
  EXPECT_NEAR(angleBetween(through_tf.heading(), pose.heading()), 0.0, 1e-6);
}

TEST_F(GridSlamStageTest, AScanThatComesLateIsGivenTheOdometryOfItsTime) {
  mountScanner();
  odometryAt(100.0);
  nav_msgs::Odometry stopped = odometry(100.4);
  stopped.twist.twist.linear.x = 0.0;
  stage_.handleOdometry(stopped);
  const auto output = scanAt(100.1);
  ASSERT_TRUE(output);
  ASSERT_EQ(output->transforms.size(), 1U);
  EXPECT_NEAR(output->transforms[0].transform.translation.x, -8.0 * 0.1, 1e-6);
}

TEST_F(GridSlamStageTest, FramesOfTheSameOrNoNameAreRefused) {
  const auto stageOf = [this](const std::string& odom_frame) {
    GridSlamStageOptions options;
    options.frames.odom = odom_frame;
    GridSlamStage stage(options, buffer_, monitor_);
  };
  EXPECT_THROW(stageOf("map"), OptionError);
  EXPECT_THROW(stageOf(""), OptionError);
  EXPECT_NO_THROW(stageOf("wheels"));
}

TEST_F(GridSlamStageTest, TheMapIsPublishedPeriodically) {
  mountScanner();
  EXPECT_TRUE(mapAfterScanAt(100.0));
  EXPECT_FALSE(mapAfterScanAt(100.5));
  EXPECT_TRUE(mapAfterScanAt(101.0));
}

TEST_F(GridSlamStageTest, ThereIsAWarningOfSilentOdometryAndTheRestContinues) {
  mountScanner();
  odometryAt(100.0);
  EXPECT_EQ(scanAt(100.1)->transforms.size(), 1U);
  const auto output = scanAt(102.0);
  ASSERT_TRUE(output);
  EXPECT_TRUE(output->transforms.empty());
  EXPECT_EQ(warnings("silent_odometry"), 1U);
}

TEST_F(GridSlamStageTest, WithoutOdometryThePoseIsOdomToBase) {
  GridSlamStageOptions options;
  options.motion.source = MotionSource::kNone;
  GridSlamStage stage(options, buffer_, monitor_);
  mountScanner();
  const auto output = stage.handleScan(samples::laserScan());
  ASSERT_TRUE(output);
  ASSERT_EQ(output->transforms.size(), 2U);
  EXPECT_EQ(output->transforms[0].child_frame_id, "odom");
  EXPECT_EQ(output->transforms[0].transform.translation.x, 0.0);
  EXPECT_EQ(output->transforms[1].child_frame_id, "base_link");
  EXPECT_EQ(monitor_.warningCount(), 0U);
}

TEST_F(GridSlamStageTest, UnavailableOdometryIsNotRead) {
  GridSlamStageOptions options;
  options.motion.source = MotionSource::kNone;
  GridSlamStage stage(options, buffer_, monitor_);
  mountScanner();
  stage.handleOdometry(odometry(100.0));
  sensor_msgs::LaserScan scan = samples::laserScan();
  scan.header.stamp = ros::Time(100.0);
  ASSERT_TRUE(stage.handleScan(scan));
  scan.header.stamp = ros::Time(100.1);
  const auto output = stage.handleScan(scan);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->pose->pose.pose.position.x, 0.0) << "the odometry would say 0.8 m";
}

TEST_F(GridSlamStageTest, AJumpBackStartsOver) {
  mountScanner();
  for (double t = 100.0; t < 101.95; t += 0.1) {
    odometryAt(t);
    scanAt(t);
  }
  const auto last = scanAt(102.0);
  ASSERT_TRUE(last);
  EXPECT_GT(last->pose->pose.pose.position.x, 5.0);
  EXPECT_TRUE(stage_.mapIfDue(Stamp::fromSeconds(102.0)));
  odometryAt(100.0);
  const auto output = scanAt(100.0);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->pose->pose.pose.position.x, 0.0);
  EXPECT_TRUE(stage_.mapIfDue(Stamp::fromSeconds(100.0)));
  EXPECT_EQ(output->transforms.size(), 1U) << "the odometry of the new run serves it";
  EXPECT_EQ(warnings("clock_restart"), 1U);
}

TEST_F(GridSlamStageTest, AScanWithoutAValidBeamMovesByOdometry) {
  mountScanner();
  odometryAt(100.0);
  scanAt(100.0);
  odometryAt(100.1);
  auto blind = samples::laserScan(std::vector<float>(3, std::numeric_limits<float>::quiet_NaN()));
  blind.header.stamp = ros::Time(100.1);
  const auto output = stage_.handleScan(blind);
  ASSERT_TRUE(output);
  EXPECT_NEAR(output->pose->pose.pose.position.x, 0.8, 0.1);
  EXPECT_EQ(warnings("no_valid_beam"), 1U);
}

TEST_F(GridSlamStageTest, BeamsAreCompensatedToTheStampOfTheScan) {
  mountScanner();
  odometryAt(100.0);
  auto scan = samples::laserScan();
  scan.time_increment = 0.01F;
  const auto output = stage_.handleScan(scan);
  ASSERT_TRUE(output);
  // At 8 m/s the beam ahead starts 0.08 m further on, and the last one 0.16 m.
  const auto& points = output->labeled_scan->points;
  ASSERT_EQ(points.size(), 3U);
  EXPECT_NEAR(points[0].x, 3.6, 1e-6);
  EXPECT_NEAR(points[1].x, 3.6 + 3.0 + 0.08, 1e-6);
  EXPECT_NEAR(points[2].x, 3.6 + 0.16, 1e-6);
  EXPECT_EQ(monitor_.warningCount(), 0U);
}

TEST_F(GridSlamStageTest, OdometryPosesGiveTheMotionOnRequest) {
  options_.motion.odometry_pose = true;
  GridSlamStage stage(options_, buffer_, monitor_);
  mountScanner();
  nav_msgs::Odometry counted = odometry(100.0);
  counted.twist.twist.linear.x = 0.0;
  stage.handleOdometry(counted);
  auto blind = samples::laserScan(std::vector<float>(3, std::numeric_limits<float>::infinity()));
  blind.header.stamp = ros::Time(100.0);
  stage.handleScan(blind);
  counted.header.stamp = ros::Time(100.1);
  counted.pose.pose.position.x += 0.5;
  stage.handleOdometry(counted);
  blind.header.stamp = ros::Time(100.1);
  const auto output = stage.handleScan(blind);
  ASSERT_TRUE(output);
  EXPECT_NEAR(output->pose->pose.pose.position.x, 0.5, 0.05);
}

TEST_F(GridSlamStageTest, AnAbsurdTwistAfterAGapLeavesThePoseOfTheOdometry) {
  options_.motion.odometry_pose = true;
  GridSlamStage stage(options_, buffer_, monitor_);
  mountScanner();
  stage.handleOdometry(odometry(100.0));
  auto blind = samples::laserScan(std::vector<float>(3, std::numeric_limits<float>::infinity()));
  blind.header.stamp = ros::Time(100.0);
  stage.handleScan(blind);
  nav_msgs::Odometry late = odometry(103.0);
  late.pose.pose.position.x = odometry(100.0).pose.pose.position.x + 1.5;
  late.twist.twist.angular.z = 26.0;
  stage.handleOdometry(late);
  blind.header.stamp = ros::Time(103.0);
  const auto output = stage.handleScan(blind);
  ASSERT_TRUE(output);
  EXPECT_NEAR(output->pose->pose.pose.position.x, 1.5, 0.1);
  EXPECT_EQ(output->transforms.size(), 1U);
  EXPECT_EQ(warnings("bad_twist"), 1U);
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(GridSlamStageTest, ThereIsAWarningOfBadBeamTimes) {
  mountScanner();
  odometryAt(100.0);
  auto scan = samples::laserScan();
  scan.time_increment = -1.0F;
  EXPECT_TRUE(stage_.handleScan(scan));
  EXPECT_EQ(warnings("bad_beam_times"), 1U);
}

TEST_F(GridSlamStageTest, AScanThatIsRepeatedWhileTheVehicleMovesIsDropped) {
  mountScanner();
  auto scan = scanOfAWall();
  const auto goOn = [&](double seconds) {
    odometryAt(seconds);
    scan.header.stamp = ros::Time(seconds);
    return stage_.handleScan(scan).has_value();
  };
  EXPECT_TRUE(goOn(100.0));
  for (const double seconds : {100.1, 100.2, 100.3}) {
    EXPECT_FALSE(goOn(seconds)) << "0.8 m on";
  }
  EXPECT_EQ(drops("frozen_scan"), 3U);
  EXPECT_EQ(monitor_.health(), HealthLevel::kNoOutput);
  scan.ranges.back() += 0.01F;
  EXPECT_TRUE(goOn(100.4));
  EXPECT_EQ(monitor_.health(), HealthLevel::kOk);
}

TEST_F(GridSlamStageTest, AtRestScansMayBeTheSame) {
  mountScanner();
  auto scan = scanOfAWall();
  for (const double seconds : {100.0, 100.1, 100.2}) {
    stage_.handleOdometry(samples::odometry(seconds, 0.0));
    scan.header.stamp = ros::Time(seconds);
    EXPECT_TRUE(stage_.handleScan(scan));
  }
}

TEST_F(GridSlamStageTest, OdometryOfOtherFramesIsDropped) {
  nav_msgs::Odometry message;
  message.header.frame_id = "world";
  message.child_frame_id = "base_link";
  stage_.handleOdometry(message);
  EXPECT_EQ(drops("wrong_frame"), 1U);
}

TEST_F(GridSlamStageTest, AStageWithoutLiveOptionsRefusesThemAll) {
  EXPECT_TRUE(stage_.live().empty());
  EXPECT_THROW(stage_.change({{"map_period", 2.0}}), OptionError);
}

}  // namespace
}  // namespace datmo::grid_slam_stage_test
