// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/descriptions.h"

#include <gtest/gtest.h>

namespace datmo::descriptions_test {
namespace {

TEST(Descriptions, AScanWithAndWithoutItsRate) {
  sensor_msgs::LaserScan scan;
  scan.header.frame_id = "laser";
  scan.ranges.resize(360);
  scan.range_max = 8.0F;
  EXPECT_EQ(descriptionOf(scan), "360 beams to 8.0 m in frame laser");
  scan.scan_time = 0.08F;
  EXPECT_EQ(descriptionOf(scan), "360 beams to 8.0 m in frame laser, 12.5 Hz");
}

TEST(Descriptions, OdometrySaysItsFrames) {
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "odom";
  odometry.child_frame_id = "base_link";
  EXPECT_EQ(descriptionOf(odometry), "in odom -> base_link");
}

TEST(Descriptions, ACloudSaysItsSize) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = "camera";
  cloud.width = 640;
  cloud.height = 480;
  EXPECT_EQ(descriptionOf(cloud), "640 x 480 points in frame camera");
}

TEST(Descriptions, ATrackSaysItsClassAndPosition) {
  TrackMessage track;
  track.id = 3;
  track.classification = ObjectMessage::CLASS_PEDESTRIAN;
  track.pose.position.x = 4.12;
  track.pose.position.y = -0.26;
  EXPECT_EQ(descriptionOf(track, "map"), "id 3, pedestrian, at (4.1, -0.3) m in map");
}

}  // namespace
}  // namespace datmo::descriptions_test
