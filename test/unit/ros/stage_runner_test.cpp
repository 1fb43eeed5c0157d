// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stage_runner.h"

#include <memory>
#include <optional>

#include <gtest/gtest.h>

namespace datmo::stage_runner_test {
namespace {

/// A stage with two inputs that counts its resets.
class StageRunnerTest : public testing::Test {
 protected:
  /// Returns null if the message was dropped.
  std::unique_ptr<int> take(const std::string& input, double seconds) {
    return runner_.serve([&] {
      runner_.check(input, ros::Time(seconds));
      runner_.processed(Stamp::fromSeconds(seconds));
      return std::make_unique<int>(resets_);
    });
  }

  StageMonitor monitor_{"stage"};
  int resets_ = 0;
  StageRunner runner_{monitor_, StreamOptions(), "forgets the road", [this] { ++resets_; }};
};

TEST_F(StageRunnerTest, GoodMessagesLeadToTimedResults) {
  EXPECT_TRUE(take("scan", 100.0));
  EXPECT_TRUE(take("scan", 100.1));
  EXPECT_EQ(monitor_.processedCount(), 2U);
  EXPECT_EQ(monitor_.lastProcessed().stamp, Stamp::fromSeconds(100.1));
  EXPECT_GE(monitor_.lastProcessed().seconds, 0.0);
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(StageRunnerTest, BadMessagesAreDroppedAndCounted) {
  take("scan", 100.0);
  EXPECT_FALSE(take("scan", 100.0));
  EXPECT_FALSE(take("scan", 99.5));
  EXPECT_FALSE(take("scan", 0.0));
  const std::map<std::string, std::uint64_t> expected{
      {"repeated_stamp", 1}, {"old_stamp", 1}, {"zero_stamp", 1}};
  EXPECT_EQ(monitor_.drops(), expected);
  EXPECT_EQ(monitor_.processedCount(), 1U);
  EXPECT_EQ(resets_, 0);
}

TEST_F(StageRunnerTest, OtherErrorsAreLeftToTheCaller) {
  EXPECT_THROW(runner_.serve([] { throw std::logic_error("a fault of the code"); }),
               std::logic_error);
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(StageRunnerTest, EachInputHasItsOwnTime) {
  take("scan", 100.0);
  EXPECT_TRUE(take("odometry", 99.5));
  EXPECT_TRUE(take("odometry", 99.6));
  EXPECT_EQ(resets_, 0);
}

TEST_F(StageRunnerTest, AClockThatJumpsBackOnAllInputsResetsThemOnce) {
  monitor_.setTime(Stamp::fromSeconds(100.0));  // it does not advance
  take("scan", 100.0);
  take("odometry", 100.0);
  EXPECT_FALSE(take("odometry", 49.9)) << "not confirmed yet";
  EXPECT_FALSE(take("scan", 49.9)) << "this one neither";
  EXPECT_EQ(resets_, 0);
  const auto served = take("odometry", 50.0);
  ASSERT_TRUE(served);
  EXPECT_EQ(*served, 1) << "reset before the message is used";
  EXPECT_TRUE(take("scan", 50.0));
  EXPECT_FALSE(take("odometry", 50.0)) << "its own stamp is known";
  EXPECT_EQ(resets_, 1);
  EXPECT_EQ(monitor_.warnings().at("clock_restart"), 1U);
  EXPECT_EQ(monitor_.drops().at("stray_stamp"), 2U);
  EXPECT_EQ(monitor_.lastError().find("stamp"), 0U);
}

TEST_F(StageRunnerTest, AClockThatJumpsOnOneInputAloneIsNotFollowed) {
  for (int message = 0; message < 40; ++message) {
    const double now = 100.0 + 0.1 * message;
    monitor_.setTime(Stamp::fromSeconds(now));
    EXPECT_TRUE(take("odometry", now));
    const bool is_wrong = message >= 10 && message < 30;
    EXPECT_EQ(take("scan", now + (is_wrong ? 5.0 : 0.0)) != nullptr, !is_wrong) << message;
  }
  EXPECT_EQ(resets_, 0);
  EXPECT_EQ(monitor_.drops().at("stray_stamp"), 20U);
}

TEST_F(StageRunnerTest, AnInputWithoutStampsContradictsNoOther) {
  monitor_.setTime(Stamp::fromSeconds(100.0));
  take("scan", 100.0);
  EXPECT_FALSE(take("odometry", 0.0));
  EXPECT_FALSE(take("scan", 160.0)) << "not confirmed yet";
  EXPECT_FALSE(take("odometry", 0.0));
  EXPECT_TRUE(take("scan", 160.1));
}

TEST_F(StageRunnerTest, AResetReportsWhyAndWhatItDoes) {
  runner_.reset("other_map", "the map is 'b', it was 'a' before");
  EXPECT_EQ(resets_, 1);
  EXPECT_EQ(monitor_.lastError(), "the map is 'b', it was 'a' before: forgets the road");
  EXPECT_EQ(monitor_.warnings().at("other_map"), 1U);
}

TEST_F(StageRunnerTest, TheFirstMessageOfAnInputIsDescribed) {
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "odom";
  odometry.child_frame_id = "base_link";
  runner_.serve("odometry", odometry, [] {});
  EXPECT_EQ(monitor_.description("odometry"), "in odom -> base_link");
}

TEST_F(StageRunnerTest, OneStrayStampResetsNothing) {
  for (int message = 0; message < 10; ++message) {
    const double seconds = 100.0 + 0.1 * message;
    monitor_.setTime(Stamp::fromSeconds(seconds));
    take("scan", message == 5 ? seconds + 1e6 : seconds);
    take("odometry", message == 7 ? seconds - 10.0 : seconds);
  }
  EXPECT_EQ(resets_, 0);
  EXPECT_EQ(monitor_.droppedCount(), 2U);
  EXPECT_EQ(monitor_.drops().at("stray_stamp"), 2U);
}

TEST_F(StageRunnerTest, ARefusedOutputResetsTheStageBeforeItsNextMessage) {
  take("scan", 100.0);
  monitor_.requestReset();
  EXPECT_EQ(resets_, 0);
  EXPECT_EQ(*take("scan", 100.1), 1);
  EXPECT_EQ(*take("scan", 100.2), 1) << "once";
  EXPECT_EQ(monitor_.resetCount(), 1U);
  EXPECT_EQ(monitor_.warnings().at("bad_output"), 1U);
}

TEST(StageRunner, WithoutStateARestartIsReportedAlone) {
  StageMonitor monitor("stage");
  StageRunner runner(monitor, StreamOptions(), "starts over");
  runner.check("scan", ros::Time(100.0));
  runner.check("scan", ros::Time(50.0));
  EXPECT_EQ(monitor.lastError(), "the clock jumped back: starts over");
}

}  // namespace
}  // namespace datmo::stage_runner_test
