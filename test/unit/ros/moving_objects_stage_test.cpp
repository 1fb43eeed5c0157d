// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/moving_objects_stage.h"

#include <limits>

#include "labeled_scan_samples.h"
#include "message_samples.h"
#include "road_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/message_conversion.h"
#include "datmo_fusion/ros/road_conversion.h"

namespace datmo {
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
    return stage_.takeLabeledScan(toMessage(scan, "base_link", "map"));
  }

  void takeRoad(double seconds, const std::string& frame = "map") {
    RoadModel road = samples::straightRoad();
    road.stamp = Stamp::fromSeconds(samples::kStart + seconds);
    stage_.takeRoadBorders(toMessage(road, frame));
  }

  StageMonitor monitor_{"moving_objects"};
  MovingObjectsStage stage_{withBorders(), monitor_};
  Point2 on_border_{10.0, 3.1};
};

TEST(MovingObjectsStageWithoutBordersTest, ServesALabeledScanOnceAndDropsBadOnes) {
  StageMonitor monitor("moving_objects");
  MovingObjectsStage stage({}, monitor);
  LabeledScan scan;
  scan.stamp = Stamp::fromSeconds(samples::kStart);
  const LabeledScanMessage message = toMessage(scan, "base_link", "map");
  const auto output = stage.takeLabeledScan(message);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->objects->header.frame_id, "base_link");
  EXPECT_EQ(output->objects->header.stamp, message.header.stamp);
  EXPECT_FALSE(output->dropped);
  EXPECT_FALSE(stage.takeLabeledScan(message));
  EXPECT_EQ(monitor.drops().at("repeated_stamp"), 1U);
  LabeledScanMessage bad = message;
  bad.pose.pose.orientation.w = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(stage.takeLabeledScan(bad));
  EXPECT_EQ(monitor.drops().at("bad_pose"), 1U);
}

TEST_F(MovingObjectsStageTest, DropsWhatLiesOnABorder) {
  takeRoad(0.0);
  const auto output = take(scanWithMover(on_border_, 0.0));
  ASSERT_TRUE(output);
  EXPECT_TRUE(output->objects->objects.empty());
  ASSERT_TRUE(output->dropped);
  EXPECT_EQ(output->dropped->header.frame_id, "base_link");
  EXPECT_EQ(output->dropped->header.stamp, output->objects->header.stamp);
  ASSERT_EQ(output->dropped->objects.size(), 1U);
  EXPECT_EQ(output->dropped->objects[0].reason, DroppedObjectMessage::ON_BORDER);
  EXPECT_EQ(output->dropped->objects[0].side, RoadBorderMessage::LEFT);
  EXPECT_TRUE(monitor_.warnings().empty());
}

TEST_F(MovingObjectsStageTest, WithoutBordersAllPassAndItIsSaid) {
  const auto output = take(scanWithMover(on_border_, 0.0));
  ASSERT_TRUE(output);
  EXPECT_EQ(output->objects->objects.size(), 1U);
  EXPECT_TRUE(output->dropped->objects.empty());
  EXPECT_EQ(monitor_.warnings().at("no_borders"), 1U);
}

TEST_F(MovingObjectsStageTest, OldBordersDropNothing) {
  takeRoad(0.0);
  EXPECT_EQ(take(scanWithMover(on_border_, 0.4))->objects->objects.size(), 0U);
  EXPECT_EQ(take(scanWithMover(on_border_, 0.6))->objects->objects.size(), 1U);
  EXPECT_EQ(monitor_.warnings().at("old_borders"), 1U);
}

TEST_F(MovingObjectsStageTest, BordersOfAnotherFrameDropNothing) {
  takeRoad(0.0, "odom");
  EXPECT_EQ(take(scanWithMover(on_border_, 0.0))->objects->objects.size(), 1U);
  EXPECT_EQ(monitor_.warnings().at("wrong_frame"), 1U);
}

TEST_F(MovingObjectsStageTest, BadBordersAreDroppedAndTheLastOnesServe) {
  takeRoad(0.0);
  RoadBorders bad = toMessage(samples::straightRoad(), "map");
  bad.borders[0].points[0].x = std::numeric_limits<float>::quiet_NaN();
  stage_.takeRoadBorders(bad);
  EXPECT_EQ(monitor_.drops().at("bad_border"), 1U);
  EXPECT_TRUE(take(scanWithMover(on_border_, 0.0))->objects->objects.empty());
}

TEST_F(MovingObjectsStageTest, AJumpBackForgetsWhatWasSeenFree) {
  const Point2 footpath(10.0, 5.774);  // in the middle of a beam
  const Point2 elsewhere(20.0, 0.0);
  for (int i = 0; i < 20; ++i) {
    take(scanWithMover(elsewhere, 10.0 + 0.06 * i));
  }
  takeRoad(11.2);
  EXPECT_EQ(take(scanWithMover(footpath, 11.2))->objects->objects.size(), 1U);
  takeRoad(0.0);
  EXPECT_EQ(take(scanWithMover(footpath, 0.0))->objects->objects.size(), 0U);
  EXPECT_EQ(monitor_.warnings().at("clock_restart"), 1U);
}

}  // namespace
}  // namespace datmo
