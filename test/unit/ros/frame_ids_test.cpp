// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/frame_ids.h"

#include "monitor_counts.h"
#include <gtest/gtest.h>

#include <sensor_msgs/LaserScan.h>

namespace datmo::frame_ids_test {
namespace {

using samples::warnings;

template <typename Message>
boost::shared_ptr<const Message> asConst(const Message& message) {
  return boost::make_shared<const Message>(message);
}

TEST(FrameIds, SlashesAtTheFrontAreStripped) {
  EXPECT_EQ(withoutSlash("/base_link"), "base_link");
  EXPECT_EQ(withoutSlash("//robot1/base_link"), "robot1/base_link");
  EXPECT_EQ(withoutSlash("base_link"), "base_link");
  EXPECT_EQ(withoutSlash("/"), "");
  EXPECT_EQ(withoutSlash(""), "");
}

TEST(FrameIds, APlainMessageIsNotCopied) {
  StageMonitor monitor("stage");
  sensor_msgs::LaserScan scan;
  scan.header.frame_id = "laser";
  const auto message = asConst(scan);
  EXPECT_EQ(withPlainFrames("scan", message, monitor), message);
  EXPECT_EQ(monitor.warningCount(), 0U);
}

TEST(FrameIds, OneNoticePerInputAndAllAreCounted) {
  StageMonitor monitor("stage");
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "/odom";
  odometry.child_frame_id = "/base_link";
  for (int i = 0; i < 3; ++i) {
    const auto plain = withPlainFrames("odometry", asConst(odometry), monitor);
    EXPECT_EQ(plain->header.frame_id, "odom");
    EXPECT_EQ(plain->child_frame_id, "base_link");
  }
  EXPECT_EQ(warnings(monitor, "leading_slash"), 1U);
  EXPECT_EQ(monitor.figures().at("messages on odometry with a leading slash stripped"), 3.0);
  sensor_msgs::LaserScan scan;
  scan.header.frame_id = "/laser";
  EXPECT_EQ(withPlainFrames("scan", asConst(scan), monitor)->header.frame_id, "laser");
  EXPECT_EQ(warnings(monitor, "leading_slash"), 2U) << "another input";
}

TEST(FrameIds, BothEndsOfEachTransformAreStripped) {
  StageMonitor monitor("stage");
  tf2_msgs::TFMessage message;
  message.transforms.resize(2);
  message.transforms[0].header.frame_id = "base_link";
  message.transforms[0].child_frame_id = "laser";
  message.transforms[1].header.frame_id = "odom";
  message.transforms[1].child_frame_id = "/base_link";
  const auto plain = withPlainFrames("/tf", asConst(message), monitor);
  EXPECT_EQ(plain->transforms[1].child_frame_id, "base_link");
  LabeledScanMessage scan;
  scan.header.frame_id = "base_link";
  scan.map_frame = "/map";
  EXPECT_EQ(withPlainFrames("labeled_scan", asConst(scan), monitor)->map_frame, "map");
}

}  // namespace
}  // namespace datmo::frame_ids_test
