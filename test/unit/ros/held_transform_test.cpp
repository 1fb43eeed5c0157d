// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/held_transform.h"

#include <vector>

#include "message_samples.h"
#include <gtest/gtest.h>

namespace datmo::held_transform_test {
namespace {

geometry_msgs::TransformStamped at(double seconds, double x) {
  auto transform = samples::transform("map", "odom", x);
  transform.header.stamp = ros::Time(seconds);
  return transform;
}

/// After scans that arrived at these times, each with a stamp 0.5 s earlier.
HeldTransform after(const std::vector<double>& times) {
  HeldTransform held;
  for (const double time : times) {
    held.set(at(time - 0.5, time));
    held.served(Stamp::fromSeconds(time));
  }
  return held;
}

bool holds(const HeldTransform& held, double seconds) {
  return held.at(Stamp::fromSeconds(seconds), Stamp::fromSeconds(seconds)).has_value();
}

TEST(HeldTransform, IsPublishedAtTheMotionsStampsWhileScansAreSilent) {
  EXPECT_FALSE(holds(HeldTransform(), 100.0)) << "no scan yet";
  const HeldTransform held = after({100.0, 100.1});
  EXPECT_FALSE(holds(held, 100.3)) << "the next scan may be late";
  const auto transform = held.at(Stamp::fromSeconds(100.4), Stamp::fromSeconds(100.5));
  ASSERT_TRUE(transform);
  EXPECT_EQ(transform->header.stamp, ros::Time(100.4));
  EXPECT_EQ(transform->child_frame_id, "odom");
  EXPECT_EQ(transform->transform.translation.x, 100.1);
  EXPECT_FALSE(holds(held, 110.0)) << "odometry alone for too long";
}

TEST(HeldTransform, LateScansAreNotSilent) {
  HeldTransform held;
  for (double time = 100.0; time < 101.0; time += 0.1) {
    held.set(at(time - 0.8, 1.0));
    held.served(Stamp::fromSeconds(time));
    EXPECT_FALSE(holds(held, time + 0.05)) << "its stamp is 0.85 s old";
  }
}

TEST(HeldTransform, ASlowScannerIsNotSilent) {
  const HeldTransform held = after({100.0, 100.5});
  EXPECT_FALSE(holds(held, 101.4));
  EXPECT_TRUE(holds(held, 102.1));
}

TEST(HeldTransform, OneGapDoesNotMakeAScannerSlow) {
  EXPECT_TRUE(holds(after({100.0, 100.1, 103.0}), 103.5));
}

TEST(HeldTransform, ARestartOfTheMapOrOfOdometryClearsIt) {
  HeldTransform held = after({100.0, 100.1});
  held.drop();
  EXPECT_FALSE(holds(held, 100.6));
  held.set(at(100.1, 1.0));
  EXPECT_TRUE(holds(held, 100.6));
  held.clear();
  EXPECT_FALSE(holds(held, 100.6));
}

}  // namespace
}  // namespace datmo::held_transform_test
