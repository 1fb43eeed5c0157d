// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/road_border_stage.h"

#include <limits>

#include "labeled_scan_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::road_border_stage_test {
namespace {

LabeledScanMessage scanAtStart() {
  return toMessage(samples::scanBetweenWalls(0.0), "base_link", "map");
}

class RoadBorderStageTest : public testing::Test {
 protected:
  /// Some time after samples::kStart.
  RoadBordersPtr scanAt(double seconds) {
    return stage_.handleLabeledScan(
        toMessage(samples::scanBetweenWalls(seconds), "base_link", "map"));
  }

  /// Returns the road after some seconds of scans.
  RoadBordersPtr drive(double from, double seconds = 2.0) {
    RoadBordersPtr last;
    for (int i = 0; i * 0.06 < seconds; ++i) {
      last = scanAt(from + i * 0.06);
    }
    return last;
  }

  StageMonitor monitor_{"road_border"};
  RoadBorderStage stage_{RoadBorderStageOptions(), monitor_};
};

TEST_F(RoadBorderStageTest, EachScanMakesARoadInTheFrameOfTheMap) {
  LabeledScanMessage scan = scanAtStart();
  scan.map_frame = "world";
  const auto road = stage_.handleLabeledScan(scan);
  ASSERT_NE(road, nullptr);
  EXPECT_EQ(road->header.stamp, scan.header.stamp);
  EXPECT_EQ(road->header.frame_id, "world");
  EXPECT_EQ(monitor_.processedCount(), 1U);
}

TEST_F(RoadBorderStageTest, WallsBesideTheRoadAreItsBorders) {
  const auto road = drive(0.0);
  ASSERT_NE(road, nullptr);
  ASSERT_FALSE(road->borders.empty());
  for (const RoadBorderMessage& border : road->borders) {
    const double expected =
        border.side == RoadBorderMessage::LEFT ? samples::kWallBeside : -samples::kWallBeside;
    EXPECT_NEAR(border.points.front().y, expected, 0.5);
  }
  EXPECT_GE(monitor_.figures().at("stretches of border on the left"), 1.0);
  EXPECT_GE(monitor_.figures().at("stretches of border on the right"), 1.0);
}

TEST_F(RoadBorderStageTest, BadScansAreDroppedAndCounted) {
  LabeledScanMessage lost = scanAtStart();
  lost.pose.pose.position.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(stage_.handleLabeledScan(lost), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "bad_pose"), 1U);
  LabeledScanMessage nowhere = scanAtStart();
  nowhere.map_frame.clear();
  EXPECT_EQ(stage_.handleLabeledScan(nowhere), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "wrong_frame"), 1U);
  EXPECT_NE(scanAt(0.0), nullptr);
}

TEST_F(RoadBorderStageTest, OldAndRepeatedScansAreDropped) {
  scanAt(0.0);
  EXPECT_EQ(scanAt(0.0), nullptr);
  EXPECT_EQ(scanAt(-0.1), nullptr);
  EXPECT_EQ(scanAt(-samples::kStart), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "repeated_stamp"), 1U);
  EXPECT_EQ(samples::drops(monitor_, "old_stamp"), 1U);
  EXPECT_EQ(samples::drops(monitor_, "zero_stamp"), 1U);
}

TEST_F(RoadBorderStageTest, ARestartOfTheClockForgetsTheRoad) {
  const RoadBorders first = *drive(0.0);
  drive(20.0);
  const auto again = drive(0.0);
  EXPECT_EQ(samples::warnings(monitor_, "clock_restart"), 1U);
  EXPECT_EQ(again->borders, first.borders);
}

TEST_F(RoadBorderStageTest, AnotherMapIsAnotherRoad) {
  drive(0.0);
  LabeledScanMessage scan = scanAtStart();
  scan.header.stamp += ros::Duration(5.0);
  scan.points.clear();
  scan.map_frame = "world";
  const auto road = stage_.handleLabeledScan(scan);
  ASSERT_NE(road, nullptr);
  EXPECT_TRUE(road->borders.empty());
  EXPECT_EQ(samples::warnings(monitor_, "other_map"), 1U);
}

}  // namespace
}  // namespace datmo::road_border_stage_test
