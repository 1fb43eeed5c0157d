// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/clock_offset.h"

#include <gtest/gtest.h>

namespace datmo::clock_offset_test {
namespace {

constexpr double kRounding = 1e-6;  // s

/// An exchange that begins at `asked` (s, our clock), with a clock that is `ahead` (s) of ours.
ClockExchange exchange(double asked, double ahead, double request_delay, double answer_delay) {
  return {Stamp::fromSeconds(asked), Stamp::fromSeconds(asked + request_delay + ahead),
          Stamp::fromSeconds(asked + request_delay + answer_delay)};
}

ClockOffsetEstimator withoutDrift() {
  ClockOffsetOptions options;
  options.max_drift = 0.0;
  return ClockOffsetEstimator(options);
}

TEST(ClockOffset, IsUnknownBeforeTheFirstAnswer) {
  EXPECT_FALSE(withoutDrift().at(Stamp::fromSeconds(1.0)));
}

TEST(ClockOffset, OneExchangeBoundsItByHalfOfTheRoundTrip) {
  ClockOffsetEstimator clock = withoutDrift();
  // Asked at 100.000, answered at 100.110 by the other clock, received at 100.040: between 0.070
  // and 0.110.
  clock.add(exchange(100.0, 0.100, 0.010, 0.030));
  const ClockOffset offset = clock.at(Stamp::fromSeconds(100.04)).value();
  EXPECT_NEAR(offset.ahead, 0.090, kRounding);
  EXPECT_NEAR(offset.uncertainty, 0.020, kRounding);
}

TEST(ClockOffset, TheFastestDelaysOfBothDirectionsAreCombined) {
  ClockOffsetEstimator clock = withoutDrift();
  clock.add(exchange(100.0, -0.005, 0.002, 0.050));  // below -0.005 + 0.002
  clock.add(exchange(101.0, -0.005, 0.050, 0.004));  // above -0.005 - 0.004
  const ClockOffset offset = clock.at(Stamp::fromSeconds(101.1)).value();
  EXPECT_NEAR(offset.ahead, -0.006, kRounding);
  EXPECT_NEAR(offset.uncertainty, 0.003, kRounding);
}

TEST(ClockOffset, OlderExchangesAreLooserBoundsAsTheClocksDrift) {
  ClockOffsetOptions options;
  options.max_drift = 1e-3;
  ClockOffsetEstimator clock(options);
  clock.add(exchange(100.0, 0.0, 0.001, 0.001));
  const ClockOffset offset = clock.at(Stamp::fromSeconds(110.0)).value();
  EXPECT_NEAR(offset.ahead, 0.0, kRounding);
  EXPECT_NEAR(offset.uncertainty, 0.001 + 1e-3 * 10.0, kRounding);
}

TEST(ClockOffset, ADriftIsFollowed) {
  constexpr double kDrift = 5e-5;
  ClockOffsetEstimator clock((ClockOffsetOptions()));
  for (int i = 0; i <= 600; ++i) {
    clock.add(exchange(100.0 + i, kDrift * i, 0.001, 0.001));
  }
  EXPECT_EQ(clock.steps(), 0U);
  const ClockOffset offset = clock.at(Stamp::fromSeconds(700.0)).value();
  EXPECT_NEAR(offset.ahead, kDrift * 600.0, offset.uncertainty + kRounding);
  EXPECT_LE(offset.uncertainty, 0.001 + kRounding);
}

TEST(ClockOffset, AStepIsKnownAfterTheNextExchange) {
  ClockOffsetEstimator clock((ClockOffsetOptions()));
  clock.add(exchange(100.0, 0.0, 0.001, 0.001));
  clock.add(exchange(101.0, 1.0, 0.003, 0.003));
  EXPECT_EQ(clock.steps(), 1U);
  const ClockOffset offset = clock.at(Stamp::fromSeconds(101.006)).value();
  EXPECT_NEAR(offset.ahead, 1.0, kRounding);
  EXPECT_NEAR(offset.uncertainty, 0.003, 1e-5);
}

TEST(ClockOffset, OurOwnMayBeSetBackAsWell) {
  ClockOffsetEstimator clock((ClockOffsetOptions()));
  clock.add(exchange(1000.0, 0.0, 0.001, 0.001));
  clock.add({Stamp::fromSeconds(1001.0), Stamp::fromSeconds(1001.0), Stamp::fromSeconds(501.0)});
  EXPECT_NEAR(clock.at(Stamp::fromSeconds(1001.0)).value().ahead, 0.0, kRounding)
      << "the answer seems to have come before the question";
  clock.add(exchange(502.0, 500.0, 0.001, 0.001));
  EXPECT_NEAR(clock.at(Stamp::fromSeconds(502.0)).value().ahead, 500.0, kRounding);
}

TEST(ClockOffset, ExchangesOutsideOfTheWindowAreForgotten) {
  ClockOffsetEstimator clock = withoutDrift();
  clock.add(exchange(100.0, 0.0, 0.001, 0.001));
  clock.add(exchange(131.0, 0.0, 0.020, 0.020));
  EXPECT_NEAR(clock.at(Stamp::fromSeconds(131.1)).value().uncertainty, 0.020, kRounding);
}

TEST(ClockOffset, ABadOptionIsRefused) {
  ClockOffsetOptions options;
  options.window = 0.0;
  EXPECT_THROW(ClockOffsetEstimator{options}, OptionError);
}

}  // namespace
}  // namespace datmo::clock_offset_test
