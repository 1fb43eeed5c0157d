// SPDX-License-Identifier: BSD-3-Clause
// Times of traffic lights: minutes of a year and marks of an hour as stamps.
#include "datmo_fusion/fusion/earth/signal_times.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo {
namespace {

constexpr double kNewYear2024 = 1704067200.0;  // s, UTC, by `date -u -d 2024-01-01 +%s`
constexpr double kMarch2024 = 1709251200.0;    // the same of 2024-03-01; it is a leap year

std::optional<Stamp> stampAt(std::int64_t minute, std::int64_t millisecond, double now) {
  Spatem message;
  SpatIntersection intersection;
  intersection.minute = minute;
  intersection.millisecond = millisecond;
  return stampOf(message, intersection, Stamp::fromSeconds(now));
}

TEST(SignalTimes, AMinuteOfTheYearIsAStamp) {
  EXPECT_NEAR(stampAt(0, 250, kNewYear2024 + 5.0)->seconds(), kNewYear2024 + 0.25, 1e-6);
  EXPECT_NEAR(stampAt(60 * 1440, 59999, kMarch2024)->seconds(), kMarch2024 + 59.999, 1e-6);
}

TEST(SignalTimes, TheYearIsTheNearest) {
  // 23:59 on the last day of 2023, received two seconds into 2024; and the other way round.
  EXPECT_NEAR(stampAt(365 * 1440 - 1, 59500, kNewYear2024 + 2.0)->seconds(), kNewYear2024 - 0.5,
              1e-6);
  EXPECT_NEAR(stampAt(0, 500, kNewYear2024 - 2.0)->seconds(), kNewYear2024 + 0.5, 1e-6);
}

TEST(SignalTimes, TheMessagesMinuteIsUsedAndWithoutOneThereIsNone) {
  Spatem message;
  SpatIntersection intersection;
  intersection.millisecond = 1000;
  EXPECT_FALSE(stampOf(message, intersection, Stamp::fromSeconds(kNewYear2024)));
  message.minute = 1;
  EXPECT_NEAR(stampOf(message, intersection, Stamp::fromSeconds(kNewYear2024))->seconds(),
              kNewYear2024 + 61.0, 1e-6);
  intersection.millisecond = 65535;
  EXPECT_FALSE(stampOf(message, intersection, Stamp::fromSeconds(kNewYear2024)));
  EXPECT_FALSE(stampAt(527040, 0, kNewYear2024));
}

TEST(SignalTimes, AMarkIsAheadUnlessItIsJustPast) {
  const auto at = [](std::int64_t mark, double now) {
    return stampOfMark(mark, Stamp::fromSeconds(kNewYear2024 + now), 10.0)->seconds() -
           kNewYear2024;
  };
  EXPECT_NEAR(at(1205, 100.0), 120.5, 1e-6);
  EXPECT_NEAR(at(50, 3590.0), 3605.0, 1e-6);
  EXPECT_NEAR(at(35990, 3605.0), 3599.0, 1e-6);
  EXPECT_NEAR(at(0, 7100.0), 7200.0, 1e-6);
  EXPECT_NEAR(at(900, 100.0), 90.0, 1e-6);
  EXPECT_NEAR(at(899, 100.0), 3689.9, 1e-6);
  for (const double minutes : {31.0, 59.0}) {
    for (const double now : {100.0, 3590.0}) {
      const double time = now + 60.0 * minutes;
      EXPECT_NEAR(at(std::llround(10.0 * std::fmod(time, 3600.0)), now), time, 1e-6);
    }
  }
  const Stamp now = Stamp::fromSeconds(kNewYear2024);
  EXPECT_FALSE(stampOfMark(36000, now, 10.0));
  EXPECT_FALSE(stampOfMark(36001, now, 10.0));
  EXPECT_FALSE(stampOfMark(std::nullopt, now, 10.0));
}

TEST(SignalTimes, EndsOfAnEventAreTheFarthestApartThatTheirMarksMayMean) {
  const Stamp now = Stamp::fromSeconds(kNewYear2024 + 100.0);
  const auto ends = [now](double first, double last) {
    SpatEvent event;
    event.timing = SpatTiming();
    event.timing->min_end = std::llround(10.0 * (100.0 + first));
    event.timing->max_end = std::llround(10.0 * (100.0 + last));
    return endOf(event, now, now);
  };
  EXPECT_NEAR(ends(10.0, 2400.0).first, 10.0, 1e-6);
  EXPECT_NEAR(ends(10.0, 2400.0).last, 2400.0, 1e-6);
  EXPECT_NEAR(ends(10.0, 3400.0).last, 3400.0, 1e-6);
  EXPECT_LT(ends(1860.0, 1860.0).first, 0.0);  // or it is long past
  EXPECT_NEAR(ends(1860.0, 1860.0).last, 1860.0, 1e-6);
  EXPECT_NEAR(ends(10.0, 5.0).first, 5.0, 1e-6);  // in the wrong order
  EXPECT_EQ(ends(10.0, 5.0).last, kEver);
}

}  // namespace
}  // namespace datmo
