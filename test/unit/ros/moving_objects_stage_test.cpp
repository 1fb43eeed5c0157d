// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/moving_objects_stage.h"

#include <limits>

#include "labeled_scan_samples.h"
#include "message_samples.h"
#include "road_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/road_conversion.h"

namespace datmo::moving_objects_stage_test {
namespace {

using samples::scanWithMover;

class MovingObjectsStageTest : public testing::Test {
 protected:
  static MovingObjectsStageOptions withBorders() {
    MovingObjectsStageOptions options;
    options.road_borders = true;
    return options;
  }

  std::optional<MovingObjectsOutput> take(const LabeledScan& scan) {
    return stage_.handleLabeledScan(toMessage(scan, "base_link", "map"));
  }

  void handleRoad(double seconds, const std::string& frame = "map") {
    RoadModel road = samples::straightRoad();
    road.stamp = Stamp::fromSeconds(samples::kStart + seconds);
    stage_.handleRoadBorders(toMessage(road, frame));
  }

  /// Returns the log odds of motion of the only object seen then.
  double motionLogOdds(const Point2& position, double seconds) {
    const auto output = take(scanWithMover(position, seconds));
    EXPECT_TRUE(output->dropped->objects.empty());
    return output->objects->objects.at(0).motion_log_odds;
  }

  StageMonitor monitor_{"moving_objects"};
  MovingObjectsStage stage_{withBorders(), monitor_};
  Point2 on_border_{10.0, 3.1};
};

TEST(MovingObjectsStageWithoutBordersTest, ProcessesALabeledScanOnceAndDropsBadOnes) {
  StageMonitor monitor("moving_objects");
  MovingObjectsStage stage({}, monitor);
  LabeledScan scan;
  scan.stamp = Stamp::fromSeconds(samples::kStart);
  const LabeledScanMessage message = toMessage(scan, "base_link", "map");
  const auto output = stage.handleLabeledScan(message);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->objects->header.frame_id, "base_link");
  EXPECT_EQ(output->objects->header.stamp, message.header.stamp);
  EXPECT_FALSE(output->dropped);
  EXPECT_FALSE(stage.handleLabeledScan(message));
  EXPECT_EQ(monitor.drops().at("repeated_stamp"), 1U);
  LabeledScanMessage bad = message;
  bad.pose.pose.orientation.w = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(stage.handleLabeledScan(bad));
  EXPECT_EQ(monitor.drops().at("bad_pose"), 1U);
}

TEST_F(MovingObjectsStageTest, ObjectsOnABorderAreLessLikelyToMove) {
  handleRoad(0.0);
  EXPECT_LT(motionLogOdds(on_border_, 0.0), 0.0);
  EXPECT_TRUE(monitor_.warnings().empty());
}

TEST_F(MovingObjectsStageTest, ByTheThesisItIsDropped) {
  MovingObjectsStageOptions options = withBorders();
  options.border_filter.method = BorderFilterMethod::kThesis;
  MovingObjectsStage stage(options, monitor_);
  RoadModel road = samples::straightRoad();
  road.stamp = Stamp::fromSeconds(samples::kStart);
  stage.handleRoadBorders(toMessage(road, "map"));
  const auto output =
      stage.handleLabeledScan(toMessage(scanWithMover(on_border_, 0.0), "base_link", "map"));
  ASSERT_TRUE(output);
  EXPECT_TRUE(output->objects->objects.empty());
  ASSERT_TRUE(output->dropped);
  EXPECT_EQ(output->dropped->header.frame_id, "base_link");
  EXPECT_EQ(output->dropped->header.stamp, output->objects->header.stamp);
  ASSERT_EQ(output->dropped->objects.size(), 1U);
  EXPECT_EQ(output->dropped->objects[0].reason, DroppedObjectMessage::ON_BORDER);
  EXPECT_EQ(output->dropped->objects[0].side, RoadBorderMessage::LEFT);
}

TEST_F(MovingObjectsStageTest, WithoutBordersTheRoadIsUnknownAndItIsReported) {
  EXPECT_EQ(motionLogOdds(on_border_, 0.0), 0.0);
  EXPECT_EQ(monitor_.warnings().at("no_borders"), 1U);
}

TEST_F(MovingObjectsStageTest, OldBordersAreNotUsed) {
  handleRoad(0.0);
  EXPECT_LT(motionLogOdds(on_border_, 0.4), 0.0);
  EXPECT_EQ(motionLogOdds(on_border_, 0.6), 0.0);
  EXPECT_EQ(monitor_.warnings().at("old_borders"), 1U);
}

TEST_F(MovingObjectsStageTest, BordersOfAnotherFrameAreNotUsed) {
  handleRoad(0.0, "odom");
  EXPECT_EQ(motionLogOdds(on_border_, 0.0), 0.0);
  EXPECT_EQ(monitor_.warnings().at("wrong_frame"), 1U);
}

TEST_F(MovingObjectsStageTest, BadBordersAreDroppedAndTheLastOnesAreUsed) {
  handleRoad(0.0);
  RoadBorders bad = toMessage(samples::straightRoad(), "map");
  bad.borders[0].points[0].x = std::numeric_limits<float>::quiet_NaN();
  stage_.handleRoadBorders(bad);
  EXPECT_EQ(monitor_.drops().at("bad_border"), 1U);
  EXPECT_LT(motionLogOdds(on_border_, 0.0), 0.0);
}

TEST_F(MovingObjectsStageTest, LiveOptionsApplyFromTheNextScanAndTheRoadIsKept) {
  handleRoad(0.0);
  EXPECT_LT(motionLogOdds(on_border_, 0.0), 0.0);
  stage_.change({{"min_points", 1000}});
  EXPECT_TRUE(take(scanWithMover(on_border_, 0.1))->objects->objects.empty());
  EXPECT_THROW(stage_.change({{"min_points", 0}}), OptionError);
  EXPECT_THROW(stage_.change({{"border_age", 1.0}}), OptionError) << "not live";
  EXPECT_TRUE(take(scanWithMover(on_border_, 0.2))->objects->objects.empty()) << "it stays";
  stage_.change({{"min_points", 1}});
  EXPECT_LT(motionLogOdds(on_border_, 0.3), 0.0) << "by the road that came before";
}

TEST_F(MovingObjectsStageTest, AJumpBackRestarts) {
  handleRoad(10.0);
  EXPECT_LT(motionLogOdds(on_border_, 10.0), 0.0);
  handleRoad(0.0);
  EXPECT_LT(motionLogOdds(on_border_, 0.0), 0.0);
  EXPECT_EQ(monitor_.warnings().at("clock_restart"), 1U);
}

}  // namespace
}  // namespace datmo::moving_objects_stage_test
