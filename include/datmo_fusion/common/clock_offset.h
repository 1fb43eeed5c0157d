// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// A question to another machine and its answer. All of its times are of clocks of machines.
struct ClockExchange {
  Stamp asked;     ///< when the question was sent, on our clock
  Stamp answered;  ///< when it was answered, on the other one
  Stamp received;  ///< when the answer had come, on ours
};

/// By how much another machine's clock is ahead of ours, s: within `ahead` +- `uncertainty`, as
/// long as the clocks do not drift apart faster than said.
struct ClockOffset {
  double ahead = 0.0;
  double uncertainty = 0.0;
};

struct ClockOffsetOptions {
  double window = 30.0;     ///< s
  double max_drift = 1e-4;  ///< s/s

  void visit(OptionVisitor& visitor);
};

/// The offset of another machine's clock by questions and answers, whose delays are not known and
/// need not be equal. The answer was given between question and receipt, so each exchange bounds
/// the offset from both sides, and all of the last time together bound it more closely than any of
/// them (Marzullo, Owicki, Maintaining the time in a distributed system, 1983): the fastest
/// question bounds it from above, the fastest answer from below. Bounds widen as they get older.
///
/// Exchanges that contradict each other tell of a clock that was set: the last one holds.
class ClockOffsetEstimator {
 public:
  /// Throws OptionError.
  explicit ClockOffsetEstimator(const Checked<ClockOffsetOptions>& options) : options_(*options) {}

  /// In the order of receipt. One whose answer came before its question (our clock was set) is left
  /// out.
  void add(const ClockExchange& exchange);

  /// At a time of our clock; none before the first exchange.
  std::optional<ClockOffset> at(Stamp now) const;

  /// How often a clock was set.
  std::uint64_t steps() const { return steps_; }

 private:
  struct Interval {
    double lower = 0.0;
    double upper = 0.0;
  };

  /// What all exchanges say; none: they contradict each other.
  std::optional<Interval> intersection(Stamp now) const;

  ClockOffsetOptions options_;
  std::deque<ClockExchange> exchanges_;  ///< of the window; the newest one is always there
  std::uint64_t steps_ = 0;
};

}  // namespace datmo
