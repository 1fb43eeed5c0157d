// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/input_progress.h"

#include <gtest/gtest.h>

namespace datmo::input_progress_test {
namespace {

const Stamp kNow = Stamp::fromSeconds(1.0);

bool nobody(const std::string& /*topic*/) { return false; }
bool somebody(const std::string& /*topic*/) { return true; }

InputProgress scanAndOdometry() {
  return InputProgress({{"scan", {"/front/scan"}}, {"odometry", {"/odom"}}});
}

TEST(InputProgress, TheFirstMessageSaysWhatItIsAndWhatIsWaitedFor) {
  StageMonitor monitor("grid_slam");
  InputProgress progress = scanAndOdometry();
  EXPECT_TRUE(progress.news(monitor, 0.0, nobody).empty());
  monitor.received("scan", kNow);
  monitor.describe("scan", [] { return std::string("360 beams to 8.0 m in laser"); });
  const auto lines = progress.news(monitor, 1.0, nobody);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_FALSE(lines[0].is_warning);
  EXPECT_EQ(
      lines[0].text,
      "first scan on /front/scan: 360 beams to 8.0 m in laser; waiting for odometry on /odom");
}

TEST(InputProgress, EachInputIsSaidOnce) {
  StageMonitor monitor("grid_slam");
  InputProgress progress = scanAndOdometry();
  monitor.received("scan", kNow);
  EXPECT_EQ(progress.news(monitor, 1.0, nobody).size(), 1U);
  monitor.received("odometry", kNow);
  const auto lines = progress.news(monitor, 2.0, nobody);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].text, "first odometry on /odom");
  monitor.received("scan", kNow);
  EXPECT_TRUE(progress.news(monitor, 100.0, nobody).empty());
}

TEST(InputProgress, WhatNeverComesIsNamedOnceAfterAWhile) {
  StageMonitor monitor("grid_slam");
  InputProgress progress = scanAndOdometry();
  monitor.received("scan", kNow);
  progress.news(monitor, 1.0, nobody);
  EXPECT_TRUE(progress.news(monitor, 4.9, nobody).empty());
  const auto lines = progress.news(monitor, 5.1, nobody);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].is_warning);
  EXPECT_EQ(lines[0].text, "waits for odometry on /odom: nobody publishes it");
  EXPECT_TRUE(progress.news(monitor, 6.0, nobody).empty());
}

TEST(InputProgress, ASilentPublisherIsNoWarning) {
  const StageMonitor monitor("tracker");
  InputProgress progress(InputProgress::Topics{{"objects", {"/objects"}}});
  const auto lines = progress.news(monitor, 10.0, somebody);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_FALSE(lines[0].is_warning);
  EXPECT_EQ(lines[0].text,
            "waits for objects on /objects: it is published, but no message has come");
}

TEST(InputProgress, AScanMayComeOnTwoTopics) {
  StageMonitor monitor("grid_slam");
  InputProgress progress = scanAndOdometry();
  progress.addTopic("scan", "/echoes");
  monitor.received("odometry", kNow);
  EXPECT_EQ(progress.news(monitor, 1.0, nobody).at(0).text,
            "first odometry on /odom; waiting for scan on /front/scan or /echoes");
  const auto echoes_alone = [](const std::string& topic) { return topic == "/echoes"; };
  EXPECT_FALSE(progress.news(monitor, 6.0, echoes_alone).at(0).is_warning);
}

}  // namespace
}  // namespace datmo::input_progress_test
