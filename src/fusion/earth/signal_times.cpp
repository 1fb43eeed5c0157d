// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/earth/signal_times.h"

#include <cmath>

namespace datmo {

namespace {

constexpr std::int64_t kNanosecond = 1000000000;  // of a second
constexpr std::int64_t kMillisecond = 1000000;    // ns
constexpr std::int64_t kMinute = 60;              // s
constexpr std::int64_t kHour = 3600;              // s
constexpr std::int64_t kDay = 86400;              // s

/// Days from 1970 to the first of January of a year (Gregorian).
std::int64_t daysTo(std::int64_t year) {
  const std::int64_t before = year - 1;
  const auto leapDays = [](std::int64_t to) { return to / 4 - to / 100 + to / 400; };
  constexpr std::int64_t kEpoch = 1969;
  return 365 * (before - kEpoch) + leapDays(before) - leapDays(kEpoch);
}

std::int64_t yearOf(Stamp stamp) {
  constexpr double kMeanYear = 365.2425 * static_cast<double>(kDay);
  auto year = 1970 + static_cast<std::int64_t>(std::floor(stamp.seconds() / kMeanYear));
  while (daysTo(year + 1) * kDay * kNanosecond <= stamp.nanoseconds) {
    ++year;
  }
  while (daysTo(year) * kDay * kNanosecond > stamp.nanoseconds) {
    --year;
  }
  return year;
}

}  // namespace

std::optional<Stamp> stampOf(const Spatem& message, const SpatIntersection& intersection,
                             Stamp now) {
  const std::optional<std::int64_t> minute =
      intersection.minute ? intersection.minute : message.minute;
  const std::optional<std::int64_t>& millisecond = intersection.millisecond;
  if (!minute || !millisecond || *minute >= SpatIntersection::kNoMinute ||
      *millisecond > SpatIntersection::kLastMillisecond) {
    return std::nullopt;
  }
  std::optional<Stamp> nearest;
  const std::int64_t this_year = yearOf(now);
  for (std::int64_t year = this_year - 1; year <= this_year + 1; ++year) {
    const std::int64_t seconds = daysTo(year) * kDay + *minute * kMinute;
    const Stamp stamp{seconds * kNanosecond + *millisecond * kMillisecond};
    if (!nearest ||
        std::abs(secondsBetween(stamp, now)) < std::abs(secondsBetween(*nearest, now))) {
      nearest = stamp;
    }
  }
  return nearest;
}

std::optional<Stamp> stampOfMark(const std::optional<std::int64_t>& mark, Stamp now) {
  constexpr std::int64_t kMark = 100 * kMillisecond;
  constexpr std::int64_t kHourTime = kHour * kNanosecond;
  if (!mark || *mark < 0 || *mark >= SpatTiming::kHour) {
    return std::nullopt;
  }
  const std::int64_t hour = now.nanoseconds - now.nanoseconds % kHourTime;
  std::int64_t time = hour + *mark * kMark;
  if (time - now.nanoseconds > kHourTime / 2) {
    time -= kHourTime;
  } else if (now.nanoseconds - time > kHourTime / 2) {
    time += kHourTime;
  }
  return Stamp{time};
}

}  // namespace datmo
