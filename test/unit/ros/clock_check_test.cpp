// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/clock_check.h"

#include <string>

#include "monitor_counts.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include <sensor_msgs/LaserScan.h>

namespace datmo::clock_check_test {
namespace {

constexpr double kPeriod = 0.1;  // s
constexpr double kDelay = 0.02;  // s
constexpr int kSet = 60;         // the message from which on the clock is off

class ClockCheckTest : public testing::Test {
 protected:
  /// Returns the stamp (s) after the check, for a message that was measured at this time (s).
  double corrected(double stamp, double measured) {
    return check_.corrected(ros::Time(stamp), Stamp::fromSeconds(measured + kDelay)).toSec();
  }

  /// A drive of 100 messages, at simulated times, whose scanner's clock is set by `step` (s).
  void drive(double step, double start = 0.0) {
    for (int i = 1; i <= 100; ++i) {
      const double measured = start + kPeriod * i;
      if (i == kSet && step < 0.0) {  // as a repeated message, until the next one
        corrected(measured + step, measured);
        continue;
      }
      EXPECT_NEAR(corrected(measured + (i < kSet ? 0.0 : step), measured), measured, 1e-6) << i;
    }
  }

  double figure() const { return monitor_.figures().at("clock of scan ahead [s]"); }

  StageMonitor monitor_{"stage"};
  ClockCheck check_{"scan", monitor_};
};

TEST_F(ClockCheckTest, AStampIsCorrectedAndReported) {
  drive(0.1);
  EXPECT_EQ(samples::warnings(monitor_, "clock_off"), 41U);
  EXPECT_NEAR(figure(), 0.1, 1e-6);
}

TEST_F(ClockCheckTest, AnInvalidStampStaysInvalid) {
  drive(0.1);
  EXPECT_EQ(corrected(0.0, 10.1), 0.0);
  EXPECT_EQ(corrected(0.05, 10.1), 0.05) << "would be before the beginning of time";
  EXPECT_NEAR(corrected(10.3, 10.2), 10.2, 1e-6) << "and the next one is put right as before";
}

TEST_F(ClockCheckTest, AStampAtTheEndOfTimeIsNotMovedBeyondIt) {
  drive(-0.1);
  EXPECT_EQ(check_.corrected(ros::TIME_MAX, Stamp::fromSeconds(10.1 + kDelay)), ros::TIME_MAX);
}

TEST_F(ClockCheckTest, ALoopedBagStartsOverAsDoesItsFigure) {
  drive(0.1);
  for (int i = 1; i <= 40; ++i) {
    const double measured = kPeriod * i;
    EXPECT_NEAR(corrected(measured, measured), measured, 1e-6) << i;
  }
  EXPECT_EQ(samples::warnings(monitor_, "clock_off"), 41U) << "those of the first run";
  EXPECT_EQ(figure(), 0.0);
}

TEST_F(ClockCheckTest, ACorrectedClockIsReportedOnceAndUsedUnchanged) {
  for (int i = 1; i <= 200; ++i) {
    const double measured = kPeriod * i;
    const double stamp = measured + (i < kSet ? 0.1 : 0.0);
    const double right = corrected(stamp, measured);
    if (i > kSet + 2 * static_cast<int>(SensorClock::kRemembered)) {
      EXPECT_NEAR(right, measured, 1e-6) << i;
    }
  }
  EXPECT_EQ(samples::warnings(monitor_, "clock_set"), 1U);
  EXPECT_EQ(figure(), 0.0);
}

/// Ports of a host that only provides its time.
class TimedPorts : public StagePorts {
 public:
  explicit TimedPorts(bool is_simulated) : is_simulated_(is_simulated) {}
  bool hasSimulatedTime() const override { return is_simulated_; }

 protected:
  void addInput(StageInput /*input*/) override {}
  StageOutput::Publish addOutput(StageOutput /*output*/) override { return {}; }

 private:
  bool is_simulated_;
};

TEST_F(ClockCheckTest, InSimulatedTimeStampsAreUnchanged) {
  for (const bool is_simulated : {true, false}) {
    ros::Time last;
    const auto take = withClockCheck<sensor_msgs::LaserScan>(
        TimedPorts(is_simulated), "scan", monitor_,
        [&](const auto& scan, Stamp /*now*/) { last = scan->header.stamp; });
    for (int i = 1; i <= 100; ++i) {
      const double measured = kPeriod * i;
      const auto scan = boost::make_shared<sensor_msgs::LaserScan>();
      scan->header.stamp = ros::Time(measured + (i < kSet ? 0.0 : 0.1));
      take(scan, Stamp::fromSeconds(measured + kDelay));
      EXPECT_NEAR(last.toSec(), is_simulated ? scan->header.stamp.toSec() : measured, 1e-6) << i;
    }
    EXPECT_EQ(samples::warnings(monitor_, "clock_off"), is_simulated ? 0U : 41U);
  }
}

}  // namespace
}  // namespace datmo::clock_check_test
