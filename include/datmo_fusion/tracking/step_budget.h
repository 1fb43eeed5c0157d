// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>

namespace datmo {

/// Returns the time of a monotonic clock, s.
using StepClock = std::function<double()>;

/// The time that one step may take. Without a clock it is unlimited, and the same input gives the
/// same output; with one, a step on a busy machine may keep fewer hypotheses.
class StepBudget {
 public:
  StepBudget() = default;
  StepBudget(StepClock clock, double seconds)
      : clock_(std::move(clock)), end_(clock_ ? clock_() + seconds : 0.0) {}

  bool isSpent() const { return clock_ && clock_() >= end_; }

 private:
  StepClock clock_;
  double end_ = 0.0;  ///< s
};

}  // namespace datmo
