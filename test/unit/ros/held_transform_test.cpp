// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/held_transform.h"

#include "message_samples.h"
#include <gtest/gtest.h>

namespace datmo::held_transform_test {
namespace {

geometry_msgs::TransformStamped at(double seconds, double x) {
  auto transform = samples::transform("map", "odom", x);
  transform.header.stamp = ros::Time(seconds);
  return transform;
}

TEST(HeldTransform, ComesUnderTheMotionsStampsWhileScansAreSilent) {
  HeldTransform held;
  EXPECT_FALSE(held.at(Stamp::fromSeconds(100.0))) << "no scan yet";
  held.set(at(100.0, 1.0));
  held.set(at(100.1, 2.0));
  EXPECT_FALSE(held.at(Stamp::fromSeconds(100.3))) << "the next scan may be late";
  const auto transform = held.at(Stamp::fromSeconds(100.5));
  ASSERT_TRUE(transform);
  EXPECT_EQ(transform->header.stamp, ros::Time(100.5));
  EXPECT_EQ(transform->child_frame_id, "odom");
  EXPECT_EQ(transform->transform.translation.x, 2.0);
  EXPECT_FALSE(held.at(Stamp::fromSeconds(110.0))) << "odometry alone for too long";
}

TEST(HeldTransform, ASlowScannerIsNotSilent) {
  HeldTransform held;
  held.set(at(100.0, 1.0));
  held.set(at(100.5, 1.0));
  EXPECT_FALSE(held.at(Stamp::fromSeconds(101.5)));
  EXPECT_TRUE(held.at(Stamp::fromSeconds(102.1)));
}

TEST(HeldTransform, AMapThatStartsOverHasNone) {
  HeldTransform held;
  held.set(at(100.0, 1.0));
  held.clear();
  EXPECT_FALSE(held.at(Stamp::fromSeconds(100.5)));
}

}  // namespace
}  // namespace datmo::held_transform_test
