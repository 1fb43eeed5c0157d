// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/clock_offset.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace datmo {

void ClockOffsetOptions::visit(OptionVisitor& visitor) {
  visitor.number({"window", "s", "time window of the exchanges that bound the offset"}, window,
                 {1.0, 600.0});
  visitor.number({"max_drift", "1",
                  "largest drift of two clocks (crystals of 50 ppm each); a clock that is being "
                  "slewed may drift faster, and then looks like one that was set"},
                 max_drift, {0.0, 0.01});
}

void ClockOffsetEstimator::add(const ClockExchange& exchange) {
  if (exchange.received < exchange.asked) {
    return;
  }
  exchanges_.push_back(exchange);
  // A stamp later than now is from before our clock was set back.
  const auto is_old = [&](const ClockExchange& other) {
    return std::abs(secondsBetween(other.received, exchange.received)) > options_.window;
  };
  exchanges_.erase(std::remove_if(exchanges_.begin(), exchanges_.end(), is_old), exchanges_.end());
  if (!intersection(exchange.received)) {
    ++steps_;
    exchanges_ = {exchange};
  }
}

std::optional<ClockOffset> ClockOffsetEstimator::at(Stamp now) const {
  const std::optional<Interval> interval = intersection(now);
  if (exchanges_.empty() || !interval) {
    return std::nullopt;
  }
  return ClockOffset{0.5 * (interval->lower + interval->upper),
                     0.5 * (interval->upper - interval->lower)};
}

std::optional<ClockOffsetEstimator::Interval> ClockOffsetEstimator::intersection(Stamp now) const {
  Interval all{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (const ClockExchange& exchange : exchanges_) {
    // The reply was sent after the request: this bounds how long the clocks may have drifted since.
    const double drift = options_.max_drift * std::abs(secondsBetween(exchange.asked, now));
    all.lower = std::max(all.lower, secondsBetween(exchange.received, exchange.answered) - drift);
    all.upper = std::min(all.upper, secondsBetween(exchange.asked, exchange.answered) + drift);
  }
  return all.lower <= all.upper ? std::make_optional(all) : std::nullopt;
}

}  // namespace datmo
