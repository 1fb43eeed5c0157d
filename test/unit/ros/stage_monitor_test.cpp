// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stage_monitor.h"

#include <gtest/gtest.h>

namespace datmo::stage_monitor_test {
namespace {

TEST(StageMonitor, CountsByReason) {
  StageMonitor monitor("stage");
  monitor.dropped(InputError("wrong_size", "five beams"));
  monitor.dropped(InputError("wrong_size", "six beams"));
  monitor.dropped(InputError("zero_stamp", "no time"));
  monitor.warned(InputError("tilted", "a bit"));
  EXPECT_EQ(monitor.drops().at("wrong_size"), 2U);
  EXPECT_EQ(monitor.droppedCount(), 3U);
  EXPECT_EQ(monitor.warningCount(), 1U);
  EXPECT_EQ(monitor.lastError(), "a bit");
}

TEST(StageMonitor, RateAndSilenceOfAnInput) {
  StageMonitor monitor("stage");
  EXPECT_FALSE(monitor.input("scan", Stamp::fromSeconds(1.0)).silence);
  for (int i = 0; i < 5; ++i) {
    monitor.received("scan", Stamp::fromSeconds(10.0 + 0.1 * i));
  }
  const InputStatus status = monitor.input("scan", Stamp::fromSeconds(12.4));
  EXPECT_EQ(status.received, 5U);
  EXPECT_NEAR(status.rate, 10.0, 1e-9);
  EXPECT_NEAR(*status.silence, 2.0, 1e-9);
}

TEST(StageMonitor, AClockSetBackRestartsTheRate) {
  StageMonitor monitor("stage");
  monitor.received("scan", Stamp::fromSeconds(20.0));
  monitor.received("scan", Stamp::fromSeconds(10.0));
  monitor.received("scan", Stamp::fromSeconds(10.5));
  EXPECT_NEAR(monitor.input("scan", Stamp::fromSeconds(10.5)).rate, 2.0, 1e-9);
  EXPECT_EQ(monitor.input("scan", Stamp::fromSeconds(9.0)).silence, 0.0);
}

TEST(StageMonitor, TimingOfAHundredMessages) {
  StageMonitor monitor("stage");
  EXPECT_EQ(monitor.timing().max, 0.0);
  for (int i = 100; i > 0; --i) {
    monitor.processed({Stamp{i}, 0.001 * i});
  }
  EXPECT_EQ(monitor.processedCount(), 100U);
  EXPECT_DOUBLE_EQ(monitor.timing().median, 0.05);
  EXPECT_DOUBLE_EQ(monitor.timing().percentile_99, 0.099);
  EXPECT_DOUBLE_EQ(monitor.timing().max, 0.1);
  EXPECT_EQ(monitor.lastProcessed().stamp, Stamp{1});
}

TEST(StageMonitor, AnEventIsAnnouncedOnce) {
  StageMonitor monitor("stage");
  monitor.announce("track", "first track: id 1");
  monitor.announce("track", "first track: id 2");
  EXPECT_EQ(monitor.handleAnnouncements(), std::vector<std::string>{"first track: id 1"});
  monitor.announce("track", "first track: id 3");
  EXPECT_TRUE(monitor.handleAnnouncements().empty());
}

TEST(StageMonitor, AnInputIsDescribedByItsFirstMessage) {
  StageMonitor monitor("stage");
  EXPECT_EQ(monitor.description("scan"), "");
  EXPECT_FALSE(monitor.hasReceived("scan"));
  monitor.describe("scan", [] { return std::string("360 beams"); });
  monitor.describe("scan", [] { return std::string("90 beams"); });
  EXPECT_EQ(monitor.description("scan"), "360 beams");
}

}  // namespace
}  // namespace datmo::stage_monitor_test
