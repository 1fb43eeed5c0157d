#include "datmo_fusion/ros/scan_poses.h"

#include <gtest/gtest.h>

#include "datmo_fusion/ros/message_conversion.h"

namespace datmo {
namespace {

SplitScanMessage scanAt(double seconds, double x) {
  SplitScan scan;
  scan.stamp = Stamp::fromSeconds(seconds);
  scan.base_in_map.pose = Pose2(x, 2.0, 0.5);
  return toMessage(scan, "base_link", "map");
}

std_msgs::Header baseAt(double seconds) { return scanAt(seconds, 0.0).header; }

TEST(ScanPosesTest, ThePoseOfTheSameStampAndFrames) {
  ScanPoses poses;
  poses.add(scanAt(1.0, 10.0));
  poses.add(scanAt(2.0, 20.0));
  const auto pose = poses.find(baseAt(1.0), "map");
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->x(), 10.0);
  EXPECT_DOUBLE_EQ(pose->y(), 2.0);
  EXPECT_NEAR(pose->heading(), 0.5, 1e-12);
  EXPECT_FALSE(poses.find(baseAt(1.5), "map"));
  EXPECT_FALSE(poses.find(baseAt(1.0), "odom"));
  std_msgs::Header other = baseAt(1.0);
  other.frame_id = "trailer";
  EXPECT_FALSE(poses.find(other, "map"));
}

TEST(ScanPosesTest, AJumpBackBeginsAnew) {
  ScanPoses poses;
  poses.add(scanAt(1.0, 10.0));
  poses.add(scanAt(2.0, 20.0));
  poses.add(scanAt(1.0, 30.0));
  EXPECT_DOUBLE_EQ(poses.find(baseAt(1.0), "map")->x(), 30.0);
  EXPECT_FALSE(poses.find(baseAt(2.0), "map"));
}

TEST(ScanPosesTest, ABoundedNumberIsKept) {
  ScanPoses poses;
  for (int i = 1; i <= 1000; ++i) {
    poses.add(scanAt(i, i));
  }
  EXPECT_TRUE(poses.find(baseAt(1000.0), "map"));
  EXPECT_TRUE(poses.find(baseAt(990.0), "map"));
  EXPECT_FALSE(poses.find(baseAt(900.0), "map"));
}

}  // namespace
}  // namespace datmo
