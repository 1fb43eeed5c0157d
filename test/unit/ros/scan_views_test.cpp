// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/scan_views.h"

#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::scan_views_test {
namespace {

LabeledScanMessage scanAt(double seconds, double x) {
  LabeledScan scan;
  scan.stamp = Stamp::fromSeconds(seconds);
  scan.base_in_map.pose = Pose2(x, 2.0, 0.5);
  return toMessage(scan, "base_link", "map");
}

void add(ScanViews& views, const LabeledScanMessage& message) {
  views.add(message, fromMessage(message));
}

std_msgs::Header baseAt(double seconds) { return scanAt(seconds, 0.0).header; }

TEST(ScanViewsTest, ThePoseOfTheSameStampAndFrames) {
  ScanViews views{VisibilityOptions()};
  add(views, scanAt(1.0, 10.0));
  add(views, scanAt(2.0, 20.0));
  const auto pose = views.pose(baseAt(1.0), "map");
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->x(), 10.0);
  EXPECT_DOUBLE_EQ(pose->y(), 2.0);
  EXPECT_NEAR(pose->heading(), 0.5, 1e-12);
  EXPECT_FALSE(views.pose(baseAt(1.5), "map"));
  EXPECT_FALSE(views.pose(baseAt(1.0), "odom"));
  std_msgs::Header other = baseAt(1.0);
  other.frame_id = "trailer";
  EXPECT_FALSE(views.pose(other, "map"));
}

TEST(ScanViewsTest, AfterAClearTheyStartOver) {
  ScanViews views{VisibilityOptions()};
  add(views, scanAt(1.0, 10.0));
  add(views, scanAt(2.0, 20.0));
  views.clear();
  EXPECT_FALSE(views.pose(baseAt(1.0), "map"));
  add(views, scanAt(1.0, 30.0));
  EXPECT_DOUBLE_EQ(views.pose(baseAt(1.0), "map")->x(), 30.0);
  EXPECT_FALSE(views.pose(baseAt(2.0), "map"));
}

TEST(ScanViewsTest, ABoundedNumberIsKept) {
  ScanViews views{VisibilityOptions()};
  for (int i = 1; i <= 1000; ++i) {
    add(views, scanAt(i, i));
  }
  EXPECT_TRUE(views.pose(baseAt(1000.0), "map"));
  EXPECT_TRUE(views.pose(baseAt(950.0), "map")) << "a second before, at 50 Hz";
  EXPECT_FALSE(views.pose(baseAt(900.0), "map"));
}

TEST(ScanViewsTest, TheVisibilityOfTheScanOfThatStamp) {
  LabeledScan scan;
  scan.stamp = Stamp::fromSeconds(1.0);
  scan.field = {degrees(-90.0), degrees(1.0), 181, 0.1, 40.0, 80.0};
  ScanViews views{VisibilityOptions()};
  add(views, toMessage(scan, "base_link", "map"));
  const Box2 ahead{{20.0, 0.0, 0.0}, 4.0, 2.0};
  const Box2 behind{{-20.0, 0.0, 0.0}, 4.0, 2.0};
  const Visibility* visibility = views.visibility(baseAt(1.0));
  ASSERT_NE(visibility, nullptr);
  EXPECT_GT(visibility->detectionProbability(ahead, 0.0), 0.9);
  EXPECT_LT(visibility->detectionProbability(behind, 0.0), 0.1);
  EXPECT_EQ(views.visibility(baseAt(1.1)), nullptr) << "no scan of that time";
  add(views, scanAt(1.2, 0.0));
  EXPECT_EQ(views.visibility(baseAt(1.2)), nullptr) << "a scan that does not tell its field";
}

}  // namespace
}  // namespace datmo::scan_views_test
