// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/sensor_clock.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "sensor_clock_samples.h"
#include <gtest/gtest.h>

namespace datmo::sensor_clock_test {
namespace {

void expectNothingFound(const Change& change, double period = kPeriod) {
  SensorClock clock;
  for (const double ahead : found(sent(change, period), clock)) {
    ASSERT_EQ(ahead, 0.0);
  }
  EXPECT_EQ(clock.steps(), 0U);
}

TEST(SensorClockTest, AStepIsDetectedByItsFirstMessageOrElseByTheSecond) {
  for (const double period : {0.02, 0.06, 0.1}) {
    for (const double step : {0.1, -0.1, 0.04, -0.04, 0.8, -0.8}) {
      SensorClock clock;
      const auto messages =
          sent([&](Sent& one, double measured) { one.stamp += isDuring(measured) ? step : 0.0; },
               period);
      const std::vector<double> ahead = found(messages, clock);
      for (std::size_t i = 0; i < ahead.size(); ++i) {
        if (i > 0 && messages[i].stamp < messages[i - 1].stamp + 0.015) {
          continue;  // as a repeated message
        }
        const double truth = messages[i].stamp - messages[i].arrival + kDelay;
        ASSERT_NEAR(ahead[i], truth, 1e-6) << period << " s, " << step << " s, message " << i;
      }
      EXPECT_EQ(clock.steps(), 2U);
    }
  }
}

TEST(SensorClockTest, LateMessagesAreResolvedByTheDelaysOfTheNextOnes) {
  std::mt19937 random(1);
  std::exponential_distribution<double> wait(1.0 / 0.02);
  for (const double step : {0.1, -0.1}) {
    SensorClock clock;
    const auto messages = sent(
        [&](Sent& one, double measured) {
          one.stamp += isDuring(measured) ? step : 0.0;
          one.arrival += wait(random);
        },
        0.02);
    int wrong = 0;
    double last = 0.0;
    for (const Sent& one : messages) {  // in order, as over one connection
      last = std::max(last, one.arrival);
      const double ahead = clock.add(Stamp::fromSeconds(one.stamp), Stamp::fromSeconds(last));
      const double measured = 100.0 + 0.02 * static_cast<double>(&one - messages.data());
      wrong += std::abs(ahead - (isDuring(measured) ? step : 0.0)) > 0.01 ? 1 : 0;
    }
    EXPECT_LE(wrong, 2 * static_cast<int>(SensorClock::kRemembered)) << step;
    EXPECT_EQ(clock.ahead(), 0.0);
  }
}

TEST(SensorClockTest, AResentOldMessageIsNoStep) {
  for (const double age : {0.06, 0.12, 0.6}) {
    expectNothingFound(
        [&](Sent& one, double measured) {
          one.stamp -= std::abs(measured - 105.04) < 0.03 ? age : 0.0;
        },
        0.06);
  }
}

TEST(SensorClockTest, MessagesThatAreLateLostOrDoubleAreNoStep) {
  for (const double period : {0.02, 0.06, 0.1}) {
    for (const double late : {0.1, 0.2, 0.5}) {
      expectNothingFound(
          [&](Sent& one, double measured) { one.arrival += isDuring(measured) ? late : 0.0; },
          period);
    }
    for (const int every : {2, 7, 50}) {
      int count = 0;
      expectNothingFound(
          [&](Sent& one, double measured) {
            one.arrival = isDuring(measured) && ++count % every == 0 ? NAN : one.arrival;
          },
          period);
    }
    expectNothingFound(
        [](Sent& one, double measured) { one.arrival = isDuring(measured) ? NAN : one.arrival; },
        period);
  }
}

TEST(SensorClockTest, PausesAndDriftAreNoStep) {
  expectNothingFound([](Sent& one, double measured) {
    one.stamp += measured > 110.0 ? 0.45 : 0.0;
    one.arrival += measured > 110.0 ? 0.45 : 0.0;
  });
  expectNothingFound([](Sent& one, double measured) { one.stamp += 1e-4 * (measured - 100.0); });
}

TEST(SensorClockTest, ABagThatIsPlayedFasterThanTheArrivalsClockIsNoStep) {
  int count = 0;
  expectNothingFound([&](Sent& one, double measured) {
    one.arrival = ++count % 50 == 0 ? NAN : 100.0 + 0.5 * (measured - 100.0);
  });
}

TEST(SensorClockTest, AClockThatStaysOffMayDrift) {
  for (const double drift : {-1e-3, 1e-3}) {  // ten times a crystal's, for ten times as long
    SensorClock clock;
    found(sent([drift](Sent& one, double measured) {
            one.stamp += measured < 110.0 ? 0.0 : 0.1 + drift * (measured - 110.0);
          }),
          clock);
    EXPECT_NEAR(clock.ahead(), 0.1, 1e-3) << "the step";
    EXPECT_EQ(clock.steps(), 1U);
  }
}

TEST(SensorClockTest, ASensorThatChangesItsRateIsJudgedByTheNewOne) {
  SensorClock clock;
  std::vector<Sent> messages = sent([](Sent& one, double measured) {
    const double slower = measured + std::max(0.0, measured - 110.02);  // at a message
    one = {slower + (measured > 120.0 ? 0.1 : 0.0), slower + kDelay};
  });
  found(messages, clock);
  EXPECT_NEAR(clock.ahead(), 0.1, 1e-6);
  EXPECT_EQ(clock.steps(), 1U);
}

TEST(SensorClockTest, BunchedRecordTimesAndMissingPeriodsAreNotJudged) {
  const auto change = [](Sent& one, double measured) {
    one.stamp += isDuring(measured) ? 0.1 : 0.0;
    one.arrival = std::ceil(measured / 5.0) * 5.0;
  };
  SensorClock clock;
  found(sent(change), clock);
  EXPECT_EQ(clock.ahead(), 0.0);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.025, 0.025);
  expectNothingFound([&](Sent& one, double /*measured*/) {
    one.stamp += jitter(random);
    one.arrival = one.stamp;
  });
  expectNothingFound([&](Sent& one, double /*measured*/) { one.stamp += 1.2 * jitter(random); });
}

TEST(SensorClockTest, ArrivalsBeforeTheirStampsShowAClockThatIsAhead) {
  const auto leadOf = [](const Change& change) {
    SensorClock clock;
    found(sent(change), clock);
    EXPECT_EQ(clock.steps(), 0U);
    return clock.lead();
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> wait(0.0, 0.1);
  EXPECT_NEAR(leadOf([](Sent& one, double) { one.stamp += 0.1; }), 0.1 - kDelay, 1e-6);
  EXPECT_EQ(leadOf([](Sent& one, double) { one.stamp -= 0.1; }), 0.0) << "or a slow network";
  EXPECT_EQ(leadOf([](Sent& one, double) { one.stamp += kDelay; }), 0.0);
  EXPECT_EQ(leadOf([&](Sent& one, double) { one.arrival -= wait(random); }), 0.0)
      << "the clock of a bag that is played fast goes in steps";
  EXPECT_EQ(leadOf([](Sent& one, double) { one.arrival -= 1e6; }), 0.0) << "without a clock";
}

TEST(SensorClockTest, AClockJumpStartsOver) {
  SensorClock clock;
  const auto messages = sent([](Sent& one, double measured) {
    one.stamp += isDuring(measured) ? 0.1 : 0.0;
    one.stamp -= measured > 112.0 ? 100.0 : 0.0;
  });
  found(messages, clock);
  EXPECT_NEAR(clock.ahead(), -0.1, 1e-6) << "relative to the clock after the jump";
}

}  // namespace
}  // namespace datmo::sensor_clock_test
