// SPDX-License-Identifier: BSD-3-Clause
// Which of two clocks is correct, and for how long.
#include <cmath>
#include <functional>
#include <vector>

#include "sensor_clock_samples.h"
#include <gtest/gtest.h>

namespace datmo::sensor_clock_test {
namespace {

TEST(SensorClockReferenceTest, AnOffsetSurvivesMessagesWithStampsFarOff) {
  const auto isOne = [](double measured) { return std::abs(measured - 112.0) < 0.5 * kPeriod; };
  const std::vector<Change> changes = {
      [&](Sent& one, double measured) { one.stamp += isOne(measured) ? 1.5 : 0.0; },
      [&](Sent& one, double measured) { one.stamp -= isOne(measured) ? 1.5 : 0.0; },
      [&](Sent& one, double measured) { one.stamp = isOne(measured) ? 4e9 : one.stamp; },
      [&](Sent& one, double measured) { one.arrival += isOne(measured) ? 1.1 : 0.0; },
      [&](Sent& one, double measured) {  // they wait behind the first
        one.arrival = measured > 112.0 && measured < 114.0 ? 114.0 + kDelay : one.arrival;
      }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    SensorClock clock;
    const std::vector<double> ahead = found(sent([&](Sent& one, double measured) {
                                              one.stamp += isDuring(measured) ? 0.1 : 0.0;
                                              changes[i](one, measured);
                                            }),
                                            clock);
    for (const double measured : {111.5, 113.0, 114.9}) {
      EXPECT_NEAR(aheadAt(ahead, measured), 0.1, 1e-6)
          << "change " << i << ", " << measured << " s";
    }
    EXPECT_EQ(clock.ahead(), 0.0) << "change " << i;
    EXPECT_EQ(clock.steps(), 2U) << "change " << i;
  }
}

TEST(SensorClockReferenceTest, AClockThatIsCorrectedAfterAnInitialOffsetIsRight) {
  SensorClock clock;
  const std::vector<double> ahead = found(
      sent([](Sent& one, double measured) { one.stamp += measured < 110.0 ? 0.1 : 0.0; }), clock);
  const double settled = 110.0 + 2.5 * SensorClock::kRemembered * kPeriod;
  EXPECT_EQ(aheadAt(ahead, settled), 0.0);
  EXPECT_EQ(clock.ahead(), 0.0);
  EXPECT_EQ(clock.taken(), 1U);
}

TEST(SensorClockReferenceTest, AfterItIsSetRightItIsTheReference) {
  SensorClock clock;
  const std::vector<double> ahead = found(sent([](Sent& one, double measured) {
                                            one.stamp += measured < 110.0 ? 0.2 : 0.0;
                                            one.stamp += measured > 120.0 ? 0.1 : 0.0;
                                          }),
                                          clock);
  EXPECT_NEAR(aheadAt(ahead, 130.0), 0.1, 1e-6);
  EXPECT_NEAR(clock.ahead(), 0.1, 1e-6) << "surely wrong: its messages come before their stamps";
  EXPECT_EQ(clock.taken(), 1U);
}

TEST(SensorClockReferenceTest, IfNeitherClockIsClearlyWrongTheNewOneIsEventuallyUsed) {
  constexpr double kLong = 0.2;  // s, more messages for the same count
  for (const double step : {-0.1, 0.1}) {
    for (const double offset : {0.0, -0.15}) {
      SensorClock clock;
      const std::vector<Sent> messages =
          sent([=](Sent& one,
                   double measured) { one.stamp += offset + (measured < 110.0 ? 0.0 : step); },
               kLong);
      const std::vector<double> ahead = found(messages, clock);
      const auto at = [&](double measured) {
        return ahead.at(static_cast<std::size_t>(std::lround((measured - 100.0) / kLong)));
      };
      const bool is_sure = step > 0.0 && offset == 0.0;
      EXPECT_NEAR(at(110.0 + 0.9 * SensorClock::kMaxDoubt), step, 1e-6) << step << ", " << offset;
      const double settled = 110.0 + SensorClock::kMaxDoubt + SensorClock::kRemembered * kLong;
      EXPECT_NEAR(at(settled + kLong), is_sure ? step : 0.0, 1e-6) << step << ", " << offset;
      EXPECT_EQ(clock.taken(), is_sure ? 0U : 1U) << step << ", " << offset;
    }
  }
}

TEST(SensorClockReferenceTest, ArrivalsByAnotherClockDoNotShowWhichIsRight) {
  SensorClock clock;
  const std::vector<double> ahead = found(sent([](Sent& one, double measured) {
                                            one.arrival -= 1e6;
                                            one.stamp += isDuring(measured) ? 0.1 : 0.0;
                                          }),
                                          clock);
  EXPECT_NEAR(aheadAt(ahead, 114.9), 0.1, 1e-6);
  EXPECT_EQ(clock.taken(), 0U);
}

TEST(SensorClockReferenceTest, StampsAndArrivalsThatGoBackStartOver) {
  SensorClock clock;
  const auto add = [&clock](double stamp, double delay) {
    return clock.add(Stamp::fromSeconds(stamp), Stamp::fromSeconds(stamp + delay));
  };
  for (int i = 0; i < 100; ++i) {
    add(100.0 + kPeriod * i + (i < 60 ? 0.0 : 0.1), i < 60 ? kDelay : kDelay - 0.1);
  }
  ASSERT_NEAR(clock.ahead(), 0.1, 1e-6);
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(add(100.0 + kPeriod * i, kDelay), 0.0) << i;
  }
}

TEST(SensorClockReferenceTest, StampsAloneThatGoBackStartOverAtTheSecond) {
  SensorClock clock;
  const std::vector<double> ahead = found(sent([](Sent& one, double measured) {
                                            one.stamp += measured > 110.0 ? 0.1 : 0.0;
                                            one.stamp -= measured > 120.0 ? 20.1 : 0.0;
                                          }),
                                          clock);
  EXPECT_NEAR(aheadAt(ahead, 119.9), 0.1, 1e-6);
  EXPECT_EQ(aheadAt(ahead, 120.0 + 2.0 * kPeriod), 0.0);
  EXPECT_EQ(clock.ahead(), 0.0);
}

}  // namespace
}  // namespace datmo::sensor_clock_test
