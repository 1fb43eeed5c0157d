// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/clock_estimator.h"

#include <cmath>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include "datmo_fusion/device/device_clock.h"

namespace datmo::clock_estimator_test {
namespace {

constexpr double kStart = 1.7e9;      // s, of the computer
constexpr double kPeriod = 0.025;     // s
constexpr double kLeastDelay = 1e-3;  // s

/// A device that sends immediately, and a network that only ever delays.
class Messages {
 public:
  /// `drift`: relative drift of the device's clock, positive: slow.
  explicit Messages(double drift) : drift_(drift) {}

  /// Takes the next one; returns by how much (s) its time is too late.
  double next() {
    seconds_ += kPeriod;
    const double sent = kStart + seconds_ + host_step;
    const double device = (1.0 - drift_) * seconds_ + device_step;
    const Stamp stamp =
        clock.add(device, Stamp::fromSeconds(sent + kLeastDelay + jitter_(random_) + held_up));
    return secondsBetween(Stamp::fromSeconds(sent), stamp);
  }

  void run(double duration) {
    for (double end = seconds_ + duration; seconds_ < end;) {
      worst_ = next();
    }
  }

  ClockEstimator clock{ClockOptions()};
  double host_step = 0.0;
  double device_step = 0.0;
  double held_up = 0.0;

 private:
  double drift_;
  double seconds_ = 0.0;
  double worst_ = 0.0;
  std::mt19937 random_{7};
  std::exponential_distribution<double> jitter_{1.0 / 5e-3};
};

TEST(ClockEstimator, TheFirstMessageHasItsArrivalTime) {
  ClockEstimator clock{ClockOptions()};
  EXPECT_FALSE(clock.offset());
  const Stamp arrival = Stamp::fromSeconds(100.0);
  EXPECT_EQ(clock.add(3.0, arrival), arrival);
  EXPECT_DOUBLE_EQ(clock.offset().value(), 97.0);
}

TEST(ClockEstimator, PositiveJitterIsRemoved) {
  Messages messages(0.0);
  messages.run(20.0);
  for (int i = 0; i < 1000; ++i) {
    const double late = messages.next();
    EXPECT_GE(late, kLeastDelay - 3e-4);
    EXPECT_LE(late, kLeastDelay + 3e-4);
  }
  EXPECT_EQ(messages.clock.steps(), 0U);
}

TEST(ClockEstimator, ADriftOf100PpmIsFollowed) {
  for (const double drift : {1e-4, -1e-4}) {
    Messages messages(drift);
    messages.run(60.0);
    EXPECT_NEAR(messages.clock.drift(), drift, 1e-5);
    for (int i = 0; i < 4000; ++i) {
      const double late = messages.next();
      EXPECT_GE(late, kLeastDelay - 5e-4);
      EXPECT_LE(late, kLeastDelay + 5e-4);
    }
    EXPECT_NEAR(messages.clock.offset().value(), kStart + drift * 160.0, 5e-3);
    EXPECT_EQ(messages.clock.steps(), 0U);
  }
}

TEST(ClockEstimator, AStepOfTheDeviceClockIsDetectedImmediately) {
  for (const double step : {1.0, -1.0}) {
    Messages messages(0.0);
    messages.run(20.0);
    messages.device_step = step;
    EXPECT_LT(std::abs(messages.next()), 0.05);
    EXPECT_EQ(messages.clock.steps(), 1U);
    messages.run(5.0);
    EXPECT_NEAR(messages.next(), kLeastDelay, 5e-4);
    EXPECT_EQ(messages.clock.steps(), 1U);
  }
}

TEST(ClockEstimator, AStepOfTheComputerClockIsDetectedAfterAWhile) {
  Messages messages(0.0);
  messages.run(20.0);
  messages.host_step = 1.0;
  messages.run(1.0);
  EXPECT_EQ(messages.clock.steps(), 1U);
  EXPECT_LT(std::abs(messages.next()), 0.05);
}

TEST(ClockEstimator, DelayedMessagesAreNoStep) {
  Messages messages(0.0);
  messages.run(20.0);
  // They arrive together, 0.4 s after the first of them was sent.
  for (double held_up = 0.4; held_up > 0.0; held_up -= kPeriod) {
    messages.held_up = held_up;
    EXPECT_NEAR(messages.next(), kLeastDelay, 5e-4);
  }
  EXPECT_EQ(messages.clock.steps(), 0U);
}

TEST(ClockEstimator, ARestartKeepsTheDrift) {
  Messages messages(1e-4);
  messages.run(60.0);
  const double drift = messages.clock.drift();
  messages.clock.restart();
  EXPECT_FALSE(messages.clock.offset());
  messages.next();
  EXPECT_EQ(messages.clock.drift(), drift);
  EXPECT_EQ(messages.clock.steps(), 0U);
}

TEST(DeviceClock, TheBeginningOfSimulatedTimeIsNoDelay) {
  constexpr double kPause = 0.1;  // s
  double host = 0.0;
  DeviceClock clock(ClockOptions(), [&host] { return Stamp::fromSeconds(host); });
  clock.restart({1e-3, 1000000});
  std::uint64_t ticks = 0;
  for (int i = 0; i < 50; ++i, ticks += 100) {
    EXPECT_LE(clock.add(ticks, 0.01), Stamp());
  }
  for (host = kStart; host < kStart + 1.0; host += kPause, ticks += 100) {
    EXPECT_NEAR(secondsBetween(Stamp::fromSeconds(host), clock.add(ticks, 0.01)), -0.01, 1e-5);
  }
  EXPECT_EQ(clock.state().steps, 0U);
}

TEST(ClockEstimator, OptionsOutOfRangeAreRefused) {
  ClockOptions options;
  options.max_drift = 1.0;
  EXPECT_THROW(ClockEstimator{options}, OptionError);
}

}  // namespace
}  // namespace datmo::clock_estimator_test
