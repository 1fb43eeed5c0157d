// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/grid_fusion_stage.h"

#include <algorithm>
#include <limits>

#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/grid_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::grid_fusion_stage_test {
namespace {

constexpr Percent kOccupied = 80;
constexpr Percent kFree = 20;

/// Two rows of ten cells of 1 m, the vehicle at the left.
const GridWindow kWindow{1.0, 10, 2, {0, -1}};

class GridFusionStageTest : public testing::Test {
 protected:
  static nav_msgs::OccupancyGrid message(double seconds, Percent percent,
                                         const GridWindow& window = kWindow) {
    SensorGrid grid(Stamp::fromSeconds(seconds), window);
    std::fill(grid.cells().begin(), grid.cells().end(), percent);
    return toMessage(grid, "base_link");
  }

  void take(const std::string& source, double seconds, Percent percent) {
    take(source, message(seconds, percent));
  }

  void take(const std::string& source, const nav_msgs::OccupancyGrid& grid) {
    stage_.takeGrid(source, grid, toStamp(grid.header.stamp));
  }

  std::optional<GridFusionOutput> nextAt(double seconds) {
    return stage_.next(Stamp::fromSeconds(seconds));
  }

  /// Both sources at this time, fused.
  std::optional<GridFusionOutput> bothAt(double seconds, Percent lidar, Percent stereo) {
    take("lidar", seconds, lidar);
    take("stereo", seconds, stereo);
    return nextAt(seconds);
  }

  std::uint64_t drops(const std::string& reason) const { return samples::drops(monitor_, reason); }
  std::uint64_t warnings(const std::string& reason) const {
    return samples::warnings(monitor_, reason);
  }

  StageMonitor monitor_{"grid_fusion"};
  GridFusionStageOptions options_;
  GridFusionStage stage_{options_, monitor_};
};

TEST_F(GridFusionStageTest, GridsOfTheSameStampAreFusedAtOnce) {
  take("lidar", 100.0, kFree);
  EXPECT_FALSE(nextAt(100.0)) << "the other one may still come";
  take("stereo", 100.0, kFree);
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
  EXPECT_EQ(bothAt(100.1, kOccupied, kFree)->fused->data[0], kFree) << "stereo has the word";
  EXPECT_THROW(stage_.change({{"rule", std::string("by luck")}}), OptionError);
  EXPECT_EQ(bothAt(100.2, kOccupied, kFree)->fused->data[0], kFree) << "the last one goes on";
}

TEST_F(GridFusionStageTest, AfterTheLongestWaitItGoesOnWithoutTheOther) {
  bothAt(99.9, kFree, kFree);
  take("lidar", 100.0, kOccupied);
  EXPECT_FALSE(nextAt(100.05));
  stage_.change({{"rule", std::string("maximum")}});
  const auto output = nextAt(100.11);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->fused->data[0], kOccupied);
}

TEST_F(GridFusionStageTest, TheCallersClockNeedNotBeTheStamps) {
  const auto now = [](double seconds) { return Stamp::fromSeconds(5e8 + seconds); };
  stage_.takeGrid("lidar", message(100.0, kFree), now(0.0));
  EXPECT_FALSE(stage_.next(now(0.05)));
  EXPECT_TRUE(stage_.next(now(0.11)));
}

TEST_F(GridFusionStageTest, ASilentSourceIsSaidOnceAndTheOthersGoOn) {
  bothAt(100.0, kFree, kFree);
  stage_.change({{"rule", std::string("priority")}});
  int fused = 0;
  for (int i = 1; i < 20; ++i) {
    const double t = 100.0 + 0.1 * i;
    take("lidar", t, kOccupied);
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

TEST_F(GridFusionStageTest, ASourceThatIsAlwaysTooLateIsSaidOnceUntilItIsFusedAgain) {
  for (const double start : {100.0, 102.0}) {
    EXPECT_TRUE(bothAt(start, kFree, kFree));
    const std::uint64_t before = warnings("late_source");
    for (int i = 1; i <= 10; ++i) {
      const double t = start + 0.1 * i;
      take("lidar", t, kFree);
      EXPECT_TRUE(nextAt(t + 0.11));
      if (i > 2) {
        take("stereo", t - 0.15, kFree);
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

TEST_F(GridFusionStageTest, AStampFarAheadOfTheReferenceIsDropped) {
  const auto take = [this](const std::string& source, double stamp, double now) {
    stage_.takeGrid(source, message(stamp, kFree), Stamp::fromSeconds(now));
  };
  for (int i = 0; i < 20; ++i) {
    const double t = 100.0 + 0.1 * i;
    take("lidar", t, t);
    take("stereo", t + 0.7, t);
    const auto output = nextAt(t + 0.11);
    ASSERT_TRUE(output) << t;
    EXPECT_EQ(output->fused->header.stamp, ros::Time(t)) << "the lidar's";
  }
  EXPECT_EQ(drops("stamp_ahead"), 20U);
  take("lidar", 102.0, 102.0);
  take("stereo", 103.0, 102.0);
  EXPECT_EQ(drops("stamp_ahead"), 21U);
  EXPECT_NE(monitor_.lastError().find("102.0"), std::string::npos) << "the lidar's stamp";
  EXPECT_NE(monitor_.lastError().find("103.0"), std::string::npos) << "stereo's";
  take("stereo", 102.8, 102.8);
  take("stereo", 110.0, 103.5);
  EXPECT_EQ(drops("stamp_ahead"), 21U) << "the lidar has fallen silent";
}

TEST_F(GridFusionStageTest, WithoutTheReferenceTheOtherOneSetsTheStamps) {
  for (int i = 0; i < 20; ++i) {
    const double t = 100.0 + 0.1 * i;
    take("stereo", t, kFree);
    while (nextAt(t)) {
    }
  }
  take("stereo", 102.0, kFree);
  const auto output = nextAt(102.0);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->fused->header.stamp, ros::Time(102.0));
  EXPECT_EQ(warnings("silent_source"), 1U);
}

/// An obstacle in one cell of the upper row, else free.
nav_msgs::OccupancyGrid obstacleAt(double seconds, int column) {
  SensorGrid grid(Stamp::fromSeconds(seconds), kWindow);
  std::fill(grid.cells().begin(), grid.cells().end(), kFree);
  grid.at({column, 0}) = kOccupied;
  return toMessage(grid, "base_link");
}

nav_msgs::Odometry odometry(double seconds) {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(seconds);
  message.header.frame_id = "odom";
  message.child_frame_id = "base_link";
  message.twist.twist.linear.x = 20.0;
  return message;
}

/// Column of the first cell of the upper row that is occupied; -1 if there is none.
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
  stage_.takeOdometry(odometry(99.9));
  stage_.takeOdometry(odometry(100.0));
  take("stereo", obstacleAt(99.95, 8));
  take("lidar", 100.0, kFree);
  const auto output = nextAt(100.2);
  ASSERT_TRUE(output);
  EXPECT_EQ(obstacleIn(*output->fused), 7) << "1 m nearer after 0.05 s at 20 m/s";
}

TEST_F(GridFusionStageTest, WithoutOdometryTheyAreMovedByThePosesOfTheSlam) {
  options_.motion.source = "none";
  GridFusionStage stage(options_, monitor_);
  stage.change({{"rule", std::string("priority")}});
  stage.takeOdometry(odometry(0.0));
  for (const double t : {99.7, 99.8, 99.9}) {
    geometry_msgs::PoseWithCovarianceStamped pose;
    pose.header.stamp = ros::Time(t);
    pose.pose.pose = toMessage(Pose2(20.0 * t, 5.0, 0.0));
    stage.takePose(pose);
  }
  stage.takeGrid("stereo", obstacleAt(99.95, 8), Stamp::fromSeconds(100.0));
  stage.takeGrid("lidar", message(100.0, kFree), Stamp::fromSeconds(100.0));
  const auto output = stage.next(Stamp::fromSeconds(100.2));
  ASSERT_TRUE(output);
  EXPECT_EQ(obstacleIn(*output->fused), 7);
  EXPECT_EQ(monitor_.droppedCount(), 0U) << "odometry is not read";
}

TEST_F(GridFusionStageTest, ASourceWhoseMotionIsNotKnownIsLeftOut) {
  stage_.change({{"rule", std::string("priority")}});
  take("stereo", obstacleAt(99.95, 8));
  take("lidar", 100.0, kFree);
  const auto output = nextAt(100.2);
  ASSERT_TRUE(output);
  EXPECT_EQ(obstacleIn(*output->fused), -1);
  EXPECT_EQ(monitor_.figures().at("fused without stereo"), 1.0);
  EXPECT_EQ(monitor_.warningCount(), 0U) << "it may yet become known";
  for (int i = 1; i <= 10; ++i) {
    const double t = 100.0 + 0.1 * i;
    take("stereo", obstacleAt(t - 0.05, 8));
    take("lidar", t, kFree);
    EXPECT_TRUE(nextAt(t + 0.1));
  }
  EXPECT_EQ(warnings("no_motion"), 1U);
  EXPECT_EQ(monitor_.warningCount(), 1U);
}

TEST_F(GridFusionStageTest, GridsOfAnotherWindowAreRefusedWithBothSizes) {
  take("lidar", 100.0, kFree);
  take("stereo", message(100.0, kFree, {0.5, 20, 4, {0, -2}}));
  EXPECT_EQ(drops("wrong_window"), 1U);
  EXPECT_NE(monitor_.lastError().find("20 x 4 cells of 0.5 m"), std::string::npos);
  EXPECT_NE(monitor_.lastError().find("10 x 2 cells of 1 m"), std::string::npos);
  EXPECT_TRUE(nextAt(100.2)) << "the lidar goes on";
  EXPECT_TRUE(bothAt(100.3, kFree, kFree)) << "and so does stereo with the right window";
}

TEST_F(GridFusionStageTest, BadGridsAreDroppedAndCounted) {
  nav_msgs::OccupancyGrid grid = message(100.0, kFree);
  grid.header.frame_id = "map";
  take("lidar", grid);
  EXPECT_EQ(drops("wrong_frame"), 1U);
  grid = message(100.0, kFree);
  grid.data.pop_back();
  take("lidar", grid);
  EXPECT_EQ(drops("bad_grid"), 1U);
  take("radar", 100.0, kFree);
  EXPECT_EQ(drops("unknown_source"), 1U);
  take("lidar", 0.0, kFree);
  EXPECT_EQ(drops("zero_stamp"), 1U);
  take("lidar", 100.0, kFree);
  take("lidar", 100.0, kFree);
  EXPECT_EQ(drops("repeated_stamp"), 1U);
  take("lidar", 99.9, kFree);
  EXPECT_EQ(drops("old_stamp"), 1U);
  EXPECT_TRUE(nextAt(100.2));
}

TEST_F(GridFusionStageTest, BadMotionIsDroppedAndCounted) {
  nav_msgs::Odometry bad = odometry(100.0);
  bad.twist.twist.linear.x = std::numeric_limits<double>::quiet_NaN();
  stage_.takeOdometry(bad);
  EXPECT_EQ(drops("bad_odometry"), 1U);
  bad = odometry(100.0);
  bad.child_frame_id = "trailer";
  stage_.takeOdometry(bad);
  EXPECT_EQ(drops("wrong_frame"), 1U);
}

TEST_F(GridFusionStageTest, AJumpBackStartsAnew) {
  EXPECT_TRUE(bothAt(200.0, kFree, kFree));
  EXPECT_TRUE(bothAt(100.0, kFree, kFree));
  EXPECT_EQ(warnings("clock_restart"), 1U) << "the other source is part of the same restart";
  stage_.takeOdometry(odometry(200.0));
  stage_.takeOdometry(odometry(100.1));
  EXPECT_EQ(warnings("clock_restart"), 2U);
  EXPECT_TRUE(bothAt(99.9, kFree, kFree));
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(GridFusionStageTest, AThirdSourceIsOneMoreEntry) {
  options_.fuser.sources["radar"].priority = 2;
  options_.fuser.rule = "priority";
  GridFusionStage stage(options_, monitor_);
  EXPECT_EQ(stage.sources(), (std::vector<std::string>{"lidar", "radar", "stereo"}));
  const Stamp now = Stamp::fromSeconds(100.0);
  stage.takeGrid("lidar", message(100.0, kFree), now);
  stage.takeGrid("stereo", message(100.0, kFree), now);
  stage.takeGrid("radar", message(100.0, kOccupied), now);
  EXPECT_EQ(stage.next(now)->fused->data[0], kOccupied);
}

TEST_F(GridFusionStageTest, BadOptionsAreRefused) {
  const auto refused = [this](const std::function<void(GridFusionStageOptions&)>& spoil) {
    GridFusionStageOptions options;
    spoil(options);
    EXPECT_THROW(GridFusionStage(options, monitor_), OptionError);
  };
  refused([](auto& options) { options.fuser.rule = "by luck"; });
  refused([](auto& options) { options.matcher.reference = "radar"; });
  refused([](auto& options) { options.fuser.sources["lidar"].use = false; });
  for (const char* const name : {"fused", "conflict", "", "2nd", "rear-lidar", "a b"}) {
    refused([&](auto& options) { options.fuser.sources[name].use = true; });
  }
}

}  // namespace
}  // namespace datmo::grid_fusion_stage_test
