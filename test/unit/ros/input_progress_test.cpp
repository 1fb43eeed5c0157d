// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/input_progress.h"

#include <gtest/gtest.h>

namespace datmo::input_progress_test {
namespace {

const Stamp kNow = Stamp::fromSeconds(1.0);

std::string nobody(const std::string& /*topic*/) { return ""; }
std::string somebody(const std::string& /*topic*/) { return "a type"; }

InputProgress scanAndOdometry() {
  return InputProgress(
      {{"scan", {{"/front/scan", "a type"}}}, {"odometry", {{"/odom", "a type"}}}});
}

TEST(InputProgress, TheFirstMessageIsReportedWithTheMissingInputs) {
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

TEST(InputProgress, EachInputIsReportedOnce) {
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

TEST(InputProgress, MissingInputsAreNamedOnceAfterAWhile) {
  StageMonitor monitor("grid_slam");
  InputProgress progress = scanAndOdometry();
  monitor.received("scan", kNow);
  progress.news(monitor, 1.0, nobody);
  EXPECT_TRUE(progress.news(monitor, 4.9, nobody).empty());
  const auto lines = progress.news(monitor, 5.1, nobody);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].is_warning);
  EXPECT_EQ(lines[0].text, "waits for odometry on /odom: it has no publisher");
  EXPECT_TRUE(progress.news(monitor, 6.0, nobody).empty());
}

TEST(InputProgress, ASilentPublisherIsNoWarning) {
  const StageMonitor monitor("tracker");
  InputProgress progress({{"objects", {{"/objects", "a type"}}}});
  const auto lines = progress.news(monitor, 10.0, somebody);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_FALSE(lines[0].is_warning);
  EXPECT_EQ(lines[0].text,
            "waits for objects on /objects: it is published, but no message has been received");
}

TEST(InputProgress, AScanMayArriveOnTwoTopics) {
  StageMonitor monitor("grid_slam");
  InputProgress progress({{"scan", {{"/front/scan", "a type"}, {"/echoes", "another"}}},
                          {"odometry", {{"/odom", "a type"}}}});
  monitor.received("odometry", kNow);
  EXPECT_EQ(progress.news(monitor, 1.0, nobody).at(0).text,
            "first odometry on /odom; waiting for scan on /front/scan or /echoes");
  const auto echoes_alone = [](const std::string& topic) {
    return std::string(topic == "/echoes" ? "another" : "");
  };
  EXPECT_FALSE(progress.news(monitor, 6.0, echoes_alone).at(0).is_warning);
}

TEST(InputProgress, AWrongTypeIsReportedWithBoth) {
  const StageMonitor monitor("tracker");
  InputProgress progress({{"objects", {{"/objects", "datmo_fusion/ObjectArray"}}}});
  const auto lines = progress.news(monitor, 10.0, somebody);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].is_warning);
  EXPECT_EQ(lines[0].text,
            "waits for objects on /objects: it is published as a type, expected "
            "datmo_fusion/ObjectArray");
}

}  // namespace
}  // namespace datmo::input_progress_test
