// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/static_points_stage.h"

#include <cmath>
#include <limits>

#include "labeled_scan_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include <sensor_msgs/point_cloud2_iterator.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::static_points_stage_test {
namespace {

class StaticPointsStageTest : public testing::Test {
 protected:
  std::optional<StaticPointsOutput> take(const LabeledScan& scan) {
    return stage_.handleLabeledScan(toMessage(scan, "base_link", "map"));
  }

  StageMonitor monitor_{"static_points"};
  StaticPointsStage stage_{StaticPointsStageOptions(), monitor_};
};

TEST_F(StaticPointsStageTest, WallsArePublishedAsCloudAndScan) {
  const LabeledScan scan = samples::scanBetweenWalls(0.0);
  const auto output = take(scan);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->points->header.frame_id, "base_link");
  EXPECT_EQ(output->points->width, scan.points.size());
  for (sensor_msgs::PointCloud2ConstIterator<float> y(*output->points, "y"); y != y.end(); ++y) {
    EXPECT_NEAR(std::abs(*y), samples::kWallBeside, 1e-4);
  }
  ASSERT_NE(output->scan, nullptr);
  EXPECT_EQ(output->scan->header.frame_id, "static_scan");
  EXPECT_EQ(output->scan->header.stamp, output->points->header.stamp);
  ASSERT_EQ(output->scan->ranges.size(), scan.field.beams);
  EXPECT_NEAR(output->scan->angle_min, scan.field.first_bearing, 1e-6);
  EXPECT_NEAR(output->scan->angle_max, -scan.field.first_bearing, 1e-6);
  EXPECT_NEAR(output->scan->range_max, scan.field.free_range, 1e-6) << "free no farther";
  for (const ScanPoint& point : scan.points) {
    EXPECT_NEAR(output->scan->ranges[point.beam], point.range, 1e-4);
  }
}

TEST_F(StaticPointsStageTest, MovingPointsAreNotInThem) {
  const auto output = take(samples::scanWithMover(Point2(10.0, 0.0), 0.0));
  ASSERT_TRUE(output);
  EXPECT_EQ(output->points->width, 0U);
  EXPECT_TRUE(std::isnan(output->scan->ranges[40]));
  EXPECT_TRUE(std::isinf(output->scan->ranges[0]));
}

/// An iterator over the cloud's missing bytes is undefined behavior, which only sanitized builds
/// report (found by scripts/fuzz stages).
TEST_F(StaticPointsStageTest, AScanWithoutPointsGivesAnEmptyCloudAndAFreeScan) {
  LabeledScan scan = samples::scanBetweenWalls(0.0);
  scan.points.clear();
  const auto output = take(scan);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->points->width, 0U);
  EXPECT_TRUE(output->points->data.empty());
  EXPECT_EQ(output->points->fields.size(), 3U) << "as every cloud has";
  ASSERT_NE(output->scan, nullptr);
  ASSERT_EQ(output->scan->ranges.size(), scan.field.beams);
  for (const float range : output->scan->ranges) {
    EXPECT_TRUE(std::isinf(range));
  }
}

TEST_F(StaticPointsStageTest, TheScannersMountIsPublishedOnceAndWhenItChanges) {
  LabeledScan scan = samples::scanBetweenWalls(0.0);
  scan.scanner_in_base = Pose2(3.5, 0.0, 0.1);
  const auto first = take(scan);
  ASSERT_TRUE(first && first->mount);
  const auto& transform = first->mount->transforms.at(0);
  EXPECT_EQ(transform.header.frame_id, "base_link");
  EXPECT_EQ(transform.child_frame_id, "static_scan");
  EXPECT_NEAR(transform.transform.translation.x, 3.5, 1e-9);
  scan.stamp = scan.stamp + 0.1;
  EXPECT_EQ(take(scan)->mount, nullptr);
  scan.stamp = scan.stamp + 0.1;
  scan.scanner_in_base = Pose2(3.0, 0.0, 0.1);
  EXPECT_NE(take(scan)->mount, nullptr);
}

TEST_F(StaticPointsStageTest, WithoutAFieldThereIsACloudAndNoScan) {
  LabeledScan scan = samples::scanBetweenWalls(0.0);
  scan.field = ScanField();
  const auto output = take(scan);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->scan, nullptr);
  EXPECT_GT(output->points->width, 0U);
}

TEST_F(StaticPointsStageTest, BadScansAreDroppedAndCounted) {
  LabeledScanMessage message = toMessage(samples::scanBetweenWalls(0.0), "base_link", "map");
  message.points.front().x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(stage_.handleLabeledScan(message));
  EXPECT_EQ(monitor_.drops().at("bad_point"), 1U);
  EXPECT_TRUE(take(samples::scanBetweenWalls(1.0)));
  EXPECT_FALSE(take(samples::scanBetweenWalls(0.9))) << "its stamp is old";
}

TEST_F(StaticPointsStageTest, AClockJumpBackStartsOver) {
  EXPECT_TRUE(take(samples::scanBetweenWalls(10.0)));
  EXPECT_TRUE(take(samples::scanBetweenWalls(0.0)));
  EXPECT_EQ(monitor_.warnings().at("clock_restart"), 1U);
}

TEST(StaticPointsStageOptions, TheScanHasASeparateFrame) {
  StageMonitor monitor("static_points");
  StaticPointsStageOptions options;
  options.scan_frame = "base_link";
  EXPECT_THROW(StaticPointsStage(options, monitor), OptionError);
}

}  // namespace
}  // namespace datmo::static_points_stage_test
