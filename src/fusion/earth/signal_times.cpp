// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/earth/signal_times.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

constexpr std::int64_t kNanosecond = 1000000000;  // of a second
constexpr std::int64_t kMillisecond = 1000000;    // ns
constexpr std::int64_t kMinute = 60;              // s
constexpr std::int64_t kHour = 3600;              // s
constexpr std::int64_t kDay = 86400;              // s

constexpr double kLongestPhase = 600.0;  // s; the first event may have been active for this long

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

std::optional<Stamp> stampOfMark(const std::optional<std::int64_t>& mark, Stamp now,
                                 double max_past) {
  constexpr std::int64_t kMark = 100 * kMillisecond;
  constexpr std::int64_t kHourTime = kHour * kNanosecond;
  if (!mark || *mark < 0 || *mark >= SpatTiming::kHour) {
    return std::nullopt;
  }
  const std::int64_t hour = now.nanoseconds - now.nanoseconds % kHourTime;
  const std::int64_t earliest = (now + -max_past).nanoseconds;
  std::int64_t time = hour + *mark * kMark;
  if (time - kHourTime >= earliest) {
    time -= kHourTime;
  } else if (time < earliest) {
    time += kHourTime;
  }
  return Stamp{time};
}

std::optional<double> secondsTo(const std::optional<std::int64_t>& mark, Stamp reference,
                                Stamp from, double max_past) {
  const std::optional<Stamp> time = stampOfMark(mark, reference, max_past);
  return time ? std::optional<double>(secondsBetween(from, *time)) : std::nullopt;
}

TimeSpan endOf(const SpatEvent& event, Stamp reference, Stamp from) {
  if (!event.timing) {
    return {-kEver, kEver};
  }
  const double first =
      secondsTo(event.timing->min_end, reference, from, kLongPast).value_or(-kEver);
  const double last = secondsTo(event.timing->max_end, reference, from, kLatePast).value_or(kEver);
  return last < first ? TimeSpan{last, kEver} : TimeSpan{first, last};
}

EventStart startOf(const SpatEvent& event, const TimeSpan& before, bool is_first, Stamp reference,
                   Stamp from) {
  constexpr double kMark = 0.1;  // s, resolution of marks
  const std::optional<double> start = event.timing ? secondsTo(event.timing->start, reference, from,
                                                               is_first ? kLongestPhase : kLatePast)
                                                   : std::nullopt;
  const double due = is_first ? secondsBetween(from, reference) : before.first;
  if (!start || *start <= due + kMark) {
    return {{std::min(before.first, start.value_or(before.first)), before.last}};
  }
  return {{before.first, std::max(before.last, *start)}, *start};
}

}  // namespace datmo
