// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/stamp_gate.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

/// A stream continues if a step is at most this many times the previous one: a slow sensor may
/// skip a message.
constexpr double kMaxSteps = 2.5;

/// ROS time confirms a jump if it has moved itself by a jump within this share of it: messages wait
/// in queues.
constexpr double kTimeTolerance = 0.5;

/// A jump ahead is one of the clock if ROS time followed it by less than this share.
constexpr double kMinFollowed = 0.5;

}  // namespace

StampVerdict StampGate::judge(Stamp stamp, const std::optional<Stamp>& now,
                              const std::optional<Stamp>& others) {
  if (!newest_) {
    accept(stamp, 0.0, now, others);
    return StampVerdict::kAccept;
  }
  if (stamp == *newest_) {
    return StampVerdict::kRepeated;
  }
  const double step = secondsBetween(*newest_, stamp);
  if (!isJump(step) && !(step < 0.0 && followsStray(stamp))) {
    if (step < 0.0) {
      return StampVerdict::kOld;
    }
    accept(stamp, step, now, others);
    return StampVerdict::kAccept;
  }
  if (!isConfirmed(stamp, now, others)) {
    stray_ = stamp;
    return StampVerdict::kStray;
  }
  const bool is_ahead = step > 0.0 && isAhead(stamp, now);
  accept(stamp, followsStray(stamp) ? secondsBetween(*stray_, stamp) : last_step_, now, others);
  return step < 0.0 ? StampVerdict::kRestart
                    : (is_ahead ? StampVerdict::kAhead : StampVerdict::kAccept);
}

bool StampGate::isJump(double step) const {
  return step <= -restart_after_ || step >= std::max(restart_after_, kMaxSteps * last_step_);
}

bool StampGate::isConfirmed(Stamp stamp, const std::optional<Stamp>& now,
                            const std::optional<Stamp>& others) const {
  if (!now || !arrived_) {
    return true;
  }
  const double step = secondsBetween(*newest_, stamp);
  if (std::abs(step - secondsBetween(*arrived_, *now)) < kTimeTolerance * restart_after_) {
    return true;
  }
  const bool contradicted = others && std::abs(secondsBetween(*others, stamp)) >
                                          std::abs(secondsBetween(*others, *newest_));
  return followsStray(stamp) && !contradicted;
}

bool StampGate::followsStray(Stamp stamp) const {
  if (!stray_ || !(stamp > *stray_)) {
    return false;
  }
  const double jump = secondsBetween(*newest_, *stray_);
  return secondsBetween(*stray_, stamp) <
         std::max({restart_after_, kMaxSteps * last_step_, kMaxSteps * jump});
}

bool StampGate::isAhead(Stamp stamp, const std::optional<Stamp>& now) const {
  if (!now || !arrived_ || !followsStray(stamp)) {
    return false;
  }
  const double jump = secondsBetween(*newest_, *stray_);
  const bool is_slow = jump <= kMaxSteps * secondsBetween(*stray_, stamp);
  const bool was_wrong = beside_ && std::abs(secondsBetween(*beside_, stamp)) <
                                        std::abs(secondsBetween(*beside_, *newest_));
  return !is_slow && !was_wrong && secondsBetween(*arrived_, *now) < kMinFollowed * jump &&
         jump - secondsBetween(*arrived_, *now) >= restart_after_;
}

void StampGate::accept(Stamp stamp, double step, const std::optional<Stamp>& now,
                       const std::optional<Stamp>& others) {
  newest_ = stamp;
  arrived_ = now;
  beside_ = others;
  last_step_ = step;
  stray_.reset();
}

}  // namespace datmo
