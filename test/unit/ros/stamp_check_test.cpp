// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stamp_check.h"

#include "message_samples.h"
#include <gtest/gtest.h>

namespace datmo::stamp_check_test {
namespace {

std::string reasonAt(StampCheck& check, double seconds) {
  return samples::reasonOf([&] { check.check(ros::Time(seconds)); });
}

TEST(StampCheck, NamesTheError) {
  StampCheck check(1.0);
  EXPECT_EQ(reasonAt(check, 0.0), "zero_stamp");
  EXPECT_EQ(reasonAt(check, 10.0), "");
  EXPECT_EQ(reasonAt(check, 10.0), "repeated_stamp");
  EXPECT_EQ(reasonAt(check, 9.5), "old_stamp");
  EXPECT_EQ(check.check(ros::Time(10.1)), Arrival::kNext);
  EXPECT_EQ(check.check(ros::Time(5.0)), Arrival::kRestart);
  EXPECT_EQ(check.check(ros::Time(5.1)), Arrival::kNext);
}

TEST(StampCheck, AnUnconfirmedJumpIsNamed) {
  StampCheck check(1.0);
  check.check(ros::Time(10.0), Stamp::fromSeconds(10.0));
  EXPECT_EQ(samples::reasonOf([&] { check.check(ros::Time(15.0), Stamp::fromSeconds(10.1)); }),
            "stray_stamp");
  EXPECT_EQ(check.check(ros::Time(10.2), Stamp::fromSeconds(10.2)), Arrival::kNext);
}

TEST(StampCheck, AStampBeyondReasonIsRefusedByItself) {
  StampCheck check(1.0);
  check.check(ros::Time(10.0));
  EXPECT_EQ(samples::reasonOf([&] { check.check(ros::Time(4294967295U, 0)); }),
            "stamp_out_of_range");
  EXPECT_EQ(check.check(ros::Time(10.1)), Arrival::kNext);
}

TEST(StampCheck, BeforeRosTimeBeginsNothingCanBeStamped) {
  for (const double seconds : {0.0, -0.025}) {
    EXPECT_EQ(samples::reasonOf([&] { checkHasBegun(Stamp::fromSeconds(seconds)); }),
              "no_ros_time");
  }
  EXPECT_NO_THROW(checkHasBegun(Stamp::fromSeconds(0.001)));
}

TEST(StampCheck, TimesSurviveARoundTripToTheNanosecond) {
  const ros::Time time(1700000000, 123456789);
  EXPECT_EQ(toTime(toStamp(time)), time);
}

}  // namespace
}  // namespace datmo::stamp_check_test
