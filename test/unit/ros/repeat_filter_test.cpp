// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/repeat_filter.h"

#include <gtest/gtest.h>

namespace datmo::repeat_filter_test {
namespace {

TEST(RepeatFilter, ThousandsOfTheSameAreReportedOnce) {
  RepeatFilter filter;
  int lines = 0;
  for (int i = 0; i < 11561; ++i) {
    lines += filter.lineOf(InputError("wrong_frame", "odometry in 'odom'"), 0.01 * i) ? 1 : 0;
  }
  EXPECT_EQ(lines, 1);
}

TEST(RepeatFilter, AnotherNumberIsNoOtherCause) {
  RepeatFilter filter;
  EXPECT_EQ(filter.lineOf(InputError("tilted", "tilted by 12.1 degrees"), 0.0),
            "tilted by 12.1 degrees");
  EXPECT_FALSE(filter.lineOf(InputError("tilted", "tilted by 3 degrees"), 1.0));
  EXPECT_FALSE(filter.lineOf(InputError("tilted", "tilted by -112.25 degrees"), 2.0));
}

TEST(RepeatFilter, AnotherCauseIsReportedWithTheCountSoFar) {
  RepeatFilter filter;
  EXPECT_TRUE(filter.lineOf(InputError("wrong_frame", "in 'laser_1'"), 0.0));
  EXPECT_FALSE(filter.lineOf(InputError("wrong_frame", "in 'laser_1'"), 0.1));
  EXPECT_EQ(filter.lineOf(InputError("wrong_frame", "in 'laser_2'"), 0.2),
            "in 'laser_2' (wrong_frame: 3 so far)");
  EXPECT_FALSE(filter.lineOf(InputError("wrong_frame", "in 'laser_1'"), 0.3)) << "back and forth";
  EXPECT_EQ(filter.lineOf(InputError("zero_stamp", "in 'laser_1'"), 0.4), "in 'laser_1'")
      << "another reason has its own count";
}

TEST(RepeatFilter, MessagesThatShareAnErrorCountEachByItself) {
  RepeatFilter filter;
  EXPECT_EQ(filter.lineOf(InputError("lost", "3 on /scan"), 0.0, 3), "3 on /scan");
  EXPECT_FALSE(filter.lineOf(InputError("lost", "5 on /scan"), 0.1, 5));
  EXPECT_EQ(filter.lineOf(InputError("lost", "2 on /odom"), 0.2, 2),
            "2 on /odom (lost: 10 so far)");
}

TEST(RepeatFilter, ACauseThatReturnsAfterALongPauseIsReportedAgain) {
  RepeatFilter filter;
  EXPECT_TRUE(filter.lineOf(InputError("late", "too late"), 0.0));
  EXPECT_FALSE(filter.lineOf(InputError("late", "too late"), 50.0));
  EXPECT_FALSE(filter.lineOf(InputError("late", "too late"), 100.0)) << "50 s of quiet";
  EXPECT_EQ(filter.lineOf(InputError("late", "too late"), 161.0), "too late (late: 4 so far)");
}

TEST(RepeatFilter, EndlessCausesDoNotFillTheConsole) {
  RepeatFilter filter;
  int lines = 0;
  for (char first = 'a'; first <= 'z'; ++first) {
    for (char second = 'a'; second <= 'z'; ++second) {
      const std::string frame{first, second};
      lines += filter.lineOf(InputError("wrong_frame", frame), 0.0) ? 1 : 0;
    }
  }
  EXPECT_EQ(lines, 20);
}

}  // namespace
}  // namespace datmo::repeat_filter_test
