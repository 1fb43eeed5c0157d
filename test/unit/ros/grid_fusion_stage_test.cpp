// SPDX-License-Identifier: BSD-3-Clause
#include "grid_fusion_sample.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::grid_fusion_stage_test {
namespace {

using namespace grid_fusion_samples;

TEST_F(GridFusionStageTest, GridsOfTheSameStampAreFusedAtOnce) {
  handle("lidar", 100.0, kFree);
  EXPECT_FALSE(nextAt(100.0)) << "the other one may still come";
  handle("stereo", 100.0, kFree);
  const auto output = nextAt(100.0);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->fused->header.frame_id, "base_link");
  EXPECT_EQ(output->fused->header.stamp, ros::Time(100.0));
  EXPECT_LT(output->fused->data[0], kFree) << "two say so";
  EXPECT_EQ(output->conflict->header.stamp, ros::Time(100.0));
  EXPECT_EQ(output->conflict->info.width, 10U);
  EXPECT_FALSE(nextAt(100.0));
  EXPECT_EQ(monitor_.processedCount(), 1U);
  EXPECT_EQ(monitor_.droppedCount() + monitor_.warningCount(), 0U);
}

TEST_F(GridFusionStageTest, TheRuleChangesWhileItRuns) {
  stage_.change({{"rule", std::string("maximum")}});
  EXPECT_EQ(bothAt(100.0, kOccupied, kFree)->fused->data[0], kOccupied);
  stage_.change({{"rule", std::string("priority")}});
  EXPECT_EQ(bothAt(100.1, kOccupied, kFree)->fused->data[0], kFree) << "stereo decides";
  EXPECT_THROW(stage_.change({{"rule", std::string("by luck")}}), OptionError);
  EXPECT_EQ(bothAt(100.2, kOccupied, kFree)->fused->data[0], kFree) << "the last one goes on";
}

TEST_F(GridFusionStageTest, AfterTheLongestWaitItContinuesWithoutTheOther) {
  bothAt(99.9, kFree, kFree);
  handle("lidar", 100.0, kOccupied);
  EXPECT_FALSE(nextAt(100.05));
  stage_.change({{"rule", std::string("maximum")}});
  const auto output = nextAt(100.11);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->fused->data[0], kOccupied);
}

TEST_F(GridFusionStageTest, TheCallersClockNeedNotBeTheStamps) {
  const auto now = [](double seconds) { return Stamp::fromSeconds(5e8 + seconds); };
  stage_.handleGrid("lidar", message(100.0, kFree), now(0.0));
  EXPECT_FALSE(stage_.next(now(0.05)));
  EXPECT_TRUE(stage_.next(now(0.11)));
}

TEST_F(GridFusionStageTest, ASilentSourceIsReportedOnceAndTheOthersContinue) {
  bothAt(100.0, kFree, kFree);
  stage_.change({{"rule", std::string("priority")}});
  int fused = 0;
  for (int i = 1; i < 20; ++i) {
    const double t = 100.0 + 0.1 * i;
    handle("lidar", t, kOccupied);
    while (const auto output = nextAt(t)) {
      ++fused;
      if (t > 101.0) {
        EXPECT_EQ(output->fused->header.stamp, ros::Time(t)) << "it is not waited for any more";
        EXPECT_EQ(output->fused->data[0], kOccupied);
      }
    }
  }
  EXPECT_GE(fused, 17);
  EXPECT_EQ(warnings("silent_source"), 1U);
  EXPECT_NE(monitor_.lastError().find("stereo"), std::string::npos);
  EXPECT_GT(monitor_.figures().at("fused without stereo"), 10.0);
  EXPECT_EQ(bothAt(102.0, kOccupied, kFree)->fused->data[0], kFree) << "it is back";
  EXPECT_EQ(warnings("silent_source"), 1U);
}

TEST_F(GridFusionStageTest, ASourceThatIsAlwaysTooLateIsReportedOnceUntilItIsFusedAgain) {
  for (const double start : {100.0, 102.0}) {
    EXPECT_TRUE(bothAt(start, kFree, kFree));
    const std::uint64_t before = warnings("late_source");
    for (int i = 1; i <= 10; ++i) {
      const double t = start + 0.1 * i;
      handle("lidar", t, kFree);
      EXPECT_TRUE(nextAt(t + 0.11));
      if (i > 2) {
        handle("stereo", t - 0.15, kFree);
      }
      if (i == 4) {
        EXPECT_EQ(warnings("late_source"), before) << "it may be chance yet";
      }
    }
    EXPECT_EQ(warnings("late_source"), before + 1U);
  }
  EXPECT_NE(monitor_.lastError().find("stereo"), std::string::npos);
  EXPECT_EQ(monitor_.warningCount(), 2U);
}

TEST_F(GridFusionStageTest, WithoutTheReferenceTheOtherOneSetsTheStamps) {
  for (int i = 0; i < 20; ++i) {
    const double t = 100.0 + 0.1 * i;
    handle("stereo", t, kFree);
    while (nextAt(t)) {
    }
  }
  handle("stereo", 102.0, kFree);
  const auto output = nextAt(102.0);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->fused->header.stamp, ros::Time(102.0));
  EXPECT_EQ(warnings("silent_source"), 1U);
}

/// An obstacle in one cell of the upper row, otherwise free.
nav_msgs::OccupancyGrid obstacleAt(double seconds, int column) {
  SensorGrid grid(Stamp::fromSeconds(seconds), kWindow);
  std::fill(grid.cells().begin(), grid.cells().end(), kFree);
  grid.at({column, 0}) = kOccupied;
  return toMessage(grid, "base_link");
}

/// Returns the column of the first occupied cell of the upper row; -1 if there is none.
int obstacleIn(const nav_msgs::OccupancyGrid& message) {
  const SensorGrid grid = fromMessage(message);
  for (int column = 0; column < kWindow.columns; ++column) {
    if (isOccupied(grid.at({column, 0}))) {
      return column;
    }
  }
  return -1;
}

TEST_F(GridFusionStageTest, GridsAreMovedByTheOdometryBetweenTheirStamps) {
  stage_.change({{"rule", std::string("priority")}});
  stage_.handleOdometry(odometry(99.9));
  stage_.handleOdometry(odometry(100.0));
  handle("stereo", obstacleAt(99.95, 8));
  handle("lidar", 100.0, kFree);
  const auto output = nextAt(100.2);
  ASSERT_TRUE(output);
  EXPECT_EQ(obstacleIn(*output->fused), 7) << "1 m nearer after 0.05 s at 20 m/s";
}

TEST_F(GridFusionStageTest, WithoutOdometryTheyAreMovedByThePosesOfTheSlam) {
  options_.motion.source = MotionSource::kNone;
  GridFusionStage stage(options_, monitor_);
  stage.change({{"rule", std::string("priority")}});
  stage.handleOdometry(odometry(0.0));
  for (const double t : {99.7, 99.8, 99.9}) {
    geometry_msgs::PoseWithCovarianceStamped pose;
    pose.header.stamp = ros::Time(t);
    pose.pose.pose = toMessage(Pose2(20.0 * t, 5.0, 0.0));
    stage.handlePose(pose);
  }
  stage.handleGrid("stereo", obstacleAt(99.95, 8), Stamp::fromSeconds(100.0));
  stage.handleGrid("lidar", message(100.0, kFree), Stamp::fromSeconds(100.0));
  const auto output = stage.next(Stamp::fromSeconds(100.2));
  ASSERT_TRUE(output);
  EXPECT_EQ(obstacleIn(*output->fused), 7);
  EXPECT_EQ(monitor_.droppedCount(), 0U) << "odometry is not read";
}

TEST_F(GridFusionStageTest, ASourceOfUnknownMotionIsLeftOut) {
  stage_.change({{"rule", std::string("priority")}});
  handle("stereo", obstacleAt(99.95, 8));
  handle("lidar", 100.0, kFree);
  const auto output = nextAt(100.2);
  ASSERT_TRUE(output);
  EXPECT_EQ(obstacleIn(*output->fused), -1);
  EXPECT_EQ(monitor_.figures().at("fused without stereo"), 1.0);
  EXPECT_EQ(monitor_.warningCount(), 0U) << "it may yet become known";
  for (int i = 1; i <= 10; ++i) {
    const double t = 100.0 + 0.1 * i;
    handle("stereo", obstacleAt(t - 0.05, 8));
    handle("lidar", t, kFree);
    EXPECT_TRUE(nextAt(t + 0.1));
  }
  EXPECT_EQ(warnings("no_motion"), 1U);
  EXPECT_EQ(monitor_.warningCount(), 1U);
}

TEST_F(GridFusionStageTest, AJumpBackStartsOver) {
  EXPECT_TRUE(bothAt(200.0, kFree, kFree));
  EXPECT_TRUE(bothAt(100.0, kFree, kFree));
  EXPECT_EQ(warnings("clock_restart"), 1U) << "the other source is part of the same restart";
  stage_.handleOdometry(odometry(200.0));
  stage_.handleOdometry(odometry(100.1));
  EXPECT_EQ(warnings("clock_restart"), 2U);
  EXPECT_TRUE(bothAt(99.9, kFree, kFree));
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(GridFusionStageTest, AThirdSourceAddsAnEntry) {
  options_.fuser.sources["radar"].priority = 2;
  options_.fuser.rule = FusionRule::kPriority;
  GridFusionStage stage(options_, monitor_);
  EXPECT_EQ(stage.sources(), (std::vector<std::string>{"lidar", "radar", "stereo"}));
  const Stamp now = Stamp::fromSeconds(100.0);
  stage.handleGrid("lidar", message(100.0, kFree), now);
  stage.handleGrid("stereo", message(100.0, kFree), now);
  stage.handleGrid("radar", message(100.0, kOccupied), now);
  EXPECT_EQ(stage.next(now)->fused->data[0], kOccupied);
}

}  // namespace
}  // namespace datmo::grid_fusion_stage_test
