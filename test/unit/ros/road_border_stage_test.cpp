#include "datmo_fusion/ros/road_border_stage.h"

#include <cmath>
#include <limits>

#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/message_conversion.h"

namespace datmo {
namespace {

/// Two walls at 5 m to both sides, as a scanner sees them that stands between them and moves ahead
/// at 5 m/s.
SplitScanMessage scanBetweenWalls(double seconds) {
  SplitScanMessage scan;
  scan.header.stamp = ros::Time(seconds);
  scan.header.frame_id = "base_link";
  scan.map_frame = "map";
  scan.pose.pose = toMessage(Pose2(5.0 * (seconds - samples::kStart), 0.0, 0.0));
  scan.field.beams = 90;
  scan.field.first_bearing = -M_PI_2;
  scan.field.beam_spacing = M_PI / 90.0;
  scan.field.range = 50.0F;
  for (std::uint16_t beam = 0; beam < 90; ++beam) {
    const double bearing = -M_PI_2 + beam * M_PI / 90.0;
    const double range = 5.0 / std::max(std::abs(std::sin(bearing)), 0.01);
    if (range < 40.0) {
      ScanPointMessage point;
      point.x = static_cast<float>(range * std::cos(bearing));
      point.y = static_cast<float>(range * std::sin(bearing));
      point.range = static_cast<float>(range);
      point.bearing = static_cast<float>(bearing);
      point.beam = beam;
      scan.points.push_back(point);
    }
  }
  return scan;
}

class RoadBorderStageTest : public testing::Test {
 protected:
  RoadBordersPtr scanAt(double seconds) { return stage_.takeSplitScan(scanBetweenWalls(seconds)); }

  /// The road after some seconds of scans.
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
  SplitScanMessage scan = scanBetweenWalls(samples::kStart);
  scan.map_frame = "world";
  const auto road = stage_.takeSplitScan(scan);
  ASSERT_NE(road, nullptr);
  EXPECT_EQ(road->header.stamp, scan.header.stamp);
  EXPECT_EQ(road->header.frame_id, "world");
  EXPECT_EQ(monitor_.processedCount(), 1U);
}

TEST_F(RoadBorderStageTest, BadScansAreDroppedAndCounted) {
  SplitScanMessage lost = scanBetweenWalls(samples::kStart);
  lost.pose.pose.position.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(stage_.takeSplitScan(lost), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "bad_pose"), 1U);
  SplitScanMessage nowhere = scanBetweenWalls(samples::kStart);
  nowhere.map_frame.clear();
  EXPECT_EQ(stage_.takeSplitScan(nowhere), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "wrong_frame"), 1U);
  EXPECT_NE(scanAt(samples::kStart), nullptr);
}

TEST_F(RoadBorderStageTest, OldAndRepeatedScansAreDropped) {
  scanAt(samples::kStart);
  EXPECT_EQ(scanAt(samples::kStart), nullptr);
  EXPECT_EQ(scanAt(samples::kStart - 0.1), nullptr);
  EXPECT_EQ(scanAt(0.0), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "repeated_stamp"), 1U);
  EXPECT_EQ(samples::drops(monitor_, "old_stamp"), 1U);
  EXPECT_EQ(samples::drops(monitor_, "zero_stamp"), 1U);
}

TEST_F(RoadBorderStageTest, ARestartOfTheClockForgetsTheRoad) {
  const RoadBorders first = *drive(samples::kStart);
  drive(samples::kStart + 20.0);
  const auto again = drive(samples::kStart);
  EXPECT_EQ(samples::warnings(monitor_, "clock_restart"), 1U);
  EXPECT_EQ(again->borders, first.borders);
}

TEST_F(RoadBorderStageTest, AnotherMapIsAnotherRoad) {
  drive(samples::kStart);
  SplitScanMessage scan = scanBetweenWalls(samples::kStart + 5.0);
  scan.points.clear();
  scan.map_frame = "world";
  const auto road = stage_.takeSplitScan(scan);
  ASSERT_NE(road, nullptr);
  EXPECT_TRUE(road->borders.empty());
  EXPECT_EQ(samples::warnings(monitor_, "other_map"), 1U);
}

}  // namespace
}  // namespace datmo
