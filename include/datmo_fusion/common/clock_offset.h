// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// A request to another machine and its reply, timed by the clocks of both machines.
struct ClockExchange {
  Stamp asked;     ///< when the request was sent, on our clock
  Stamp answered;  ///< when the reply was sent, on the other clock
  Stamp received;  ///< when the reply arrived, on our clock
};

/// How far another machine's clock is ahead of ours, s: within `ahead` +- `uncertainty`, as long as
/// the clocks drift apart no faster than ClockOffsetOptions::max_drift.
struct ClockOffset {
  double ahead = 0.0;
  double uncertainty = 0.0;
};

struct ClockOffsetOptions {
  double window = 30.0;     ///< s
  double max_drift = 1e-4;  ///< s/s

  void visit(OptionVisitor& visitor);
};

/// Estimates the offset of another machine's clock from requests and replies whose delays are
/// unknown and need not be symmetric. The reply was sent between request and receipt, so each
/// exchange bounds the offset from both sides, and the intersection over a recent window is tighter
/// than any single one (Marzullo, Owicki, Maintaining the time in a distributed system, 1983): the
/// fastest request gives the upper bound, the fastest reply the lower. Bounds widen with age.
///
/// Exchanges that contradict each other mean that a clock was set: only the latest one is kept.
class ClockOffsetEstimator {
 public:
  /// Throws OptionError.
  explicit ClockOffsetEstimator(const Checked<ClockOffsetOptions>& options) : options_(*options) {}

  /// Adds an exchange, in the order of receipt. One whose reply was received before its request was
  /// sent (our clock was set) is ignored.
  void add(const ClockExchange& exchange);

  /// Returns the offset at a time of our clock; none before the first exchange.
  std::optional<ClockOffset> at(Stamp now) const;

  /// Returns how often a clock was set.
  std::uint64_t steps() const { return steps_; }

 private:
  struct Interval {
    double lower = 0.0;
    double upper = 0.0;
  };

  /// Intersection of the bounds of all exchanges; none if they contradict each other.
  std::optional<Interval> intersection(Stamp now) const;

  ClockOffsetOptions options_;
  std::deque<ClockExchange> exchanges_;  ///< within the window; never without the newest one
  std::uint64_t steps_ = 0;
};

}  // namespace datmo
