// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/sensor_clock.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

/// s; period and delay of a healthy sensor stay within this: half of the smallest step, so that
/// the two are not confused.
constexpr double kTolerance = 0.5 * SensorClock::kMinStep;

/// s/s; maximum drift between two clocks: twice a crystal's 100 ppm, with a margin.
constexpr double kMaxDrift = 5e-4;

/// Whether messages with this minimum delay (s) arrive before their stamps.
bool isEarly(double min_delay) { return min_delay < -kTolerance; }

void keep(std::deque<double>& values, double value) {
  values.push_back(value);
  if (values.size() > SensorClock::kRemembered) {
    values.pop_front();
  }
}

}  // namespace

double SensorClock::add(Stamp stamp, Stamp arrival) {
  const Message message{stamp, arrival};
  const bool is_first = !last_ || beginsAgain(message);
  const bool is_jump = !is_first && std::abs(message.delay() - last_->delay()) >= kMaxStep;
  if (is_jump && !goesOnFromJump(message)) {
    return ahead_;
  }
  if (is_first || is_jump) {
    restart(message);
  } else {
    follow(message);
  }
  const double lead = -message.delay() - ahead_;
  const bool is_early = lead >= kMinStep && lead < kMaxStep;
  lead_ = early_ > 0 ? std::min(lead_, lead) : lead;
  early_ = is_early ? early_ + 1 : 0;
  return ahead_;
}

bool SensorClock::beginsAgain(const Message& message) const {
  return secondsBetween(message.stamp, last_->stamp) >= kMaxStep &&
         secondsBetween(message.arrival, last_->arrival) >= kMaxStep;
}

bool SensorClock::goesOnFromJump(const Message& message) {
  if (!jumped_ || std::abs(message.delay() - jumped_->delay()) >= kMaxStep) {
    jumped_ = message;
    return false;
  }
  const bool is_late = message.stamp > last_->stamp && message.delay() > last_->delay();
  return !is_late || secondsBetween(jumped_->arrival, message.arrival) >= kMaxDoubt;
}

void SensorClock::follow(const Message& message) {
  jumped_.reset();
  judge(message);
  keep(recent_, message.delay() + ahead_);
  min_delay_ += kMaxDrift * std::max(0.0, secondsBetween(last_->arrival, message.arrival));
  last_ = message;
  if (ahead_ == 0.0 && !other_) {
    min_delay_ = std::min(min_delay_, message.delay());
    return;
  }
  keep(delays_, message.delay());
  if (delays_.size() == kRemembered) {
    decide();
  }
}

double SensorClock::lead() const { return early_ < kRemembered ? 0.0 : lead_; }

std::optional<double> SensorClock::period() {
  if (intervals_.size() < kRemembered) {
    return std::nullopt;
  }
  std::deque<double> sorted = intervals_;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[kRemembered / 2];
  const bool is_regular =
      sorted.front() >= median - kTolerance && sorted.back() <= median + kTolerance;
  ++judged_;
  regular_ += is_regular ? 1 : 0;
  return is_regular && 2 * regular_ >= judged_ ? std::make_optional(median) : std::nullopt;
}

bool SensorClock::arrivedOnTime(const Message& message, double period) const {
  return std::abs(secondsBetween(last_->arrival, message.arrival) - period) <= kTolerance &&
         last_->delay() + ahead_ - min_delay_ <= kTolerance &&
         last_->delay() + ahead_ >= recent_.front() - kTolerance;
}

void SensorClock::judge(const Message& message) {
  const double interval = secondsBetween(last_->stamp, message.stamp);
  const std::optional<double> period = this->period();
  if (!period || std::abs(interval - *period) < kMinStep) {
    keep(intervals_, interval);
    confirm(message, period);
    return;
  }
  const double stepped = ahead_ + interval - *period;
  const double ahead = std::abs(stepped) < kMinStep ? 0.0 : stepped;
  // If messages overtake each other, both step, one after the other.
  const bool is_first = !other_ || std::abs(ahead - *other_) < kMinStep;
  delays_.clear();
  other_ = ahead;
  set_back_.reset();
  if (!is_first || !arrivedOnTime(message, *period)) {
    keep(intervals_, interval);
  } else if (interval > kTolerance) {
    set(ahead);
  } else {
    set_back_ = ahead;  // unless it is an old message sent again
  }
}

void SensorClock::confirm(const Message& message, const std::optional<double>& period) {
  if (set_back_ && period &&
      std::abs(secondsBetween(last_->arrival, message.arrival) - *period) <= kTolerance) {
    set(*set_back_);
  }
  set_back_.reset();
}

void SensorClock::decide() {
  const double delay = *std::min_element(delays_.begin(), delays_.end());
  const auto later = [&](double ahead) { return delay + ahead - min_delay_; };
  double likeliest = ahead_;
  for (const double ahead : {other_.value_or(ahead_), 0.0}) {
    likeliest = std::abs(later(ahead)) < std::abs(later(likeliest)) ? ahead : likeliest;
  }
  if (later(likeliest) < -kTolerance) {
    restart(*last_);  // too early for any candidate: the arrivals' clock runs at another rate
    return;
  }
  if (later(likeliest) <= kTolerance) {
    min_delay_ = delay + likeliest;  // clocks drift
  }
  delays_.clear();
  if (likeliest != ahead_) {
    set(likeliest);
    other_.reset();
    return;
  }
  other_.reset();
  if (ahead_ != 0.0 && isRight()) {
    acceptStep();
  }
}

bool SensorClock::isRight() const {
  const double min_delay = min_delay_ - ahead_;  // by the clock's own time
  const bool tells =
      std::min(min_delay_, min_delay) > -kMaxStep;  // else arrivals are on another clock
  if (tells && isEarly(min_delay_) != isEarly(min_delay)) {
    return isEarly(min_delay_);
  }
  return secondsBetween(set_, last_->arrival) >= kMaxDoubt;
}

void SensorClock::acceptStep() {
  ++taken_;
  min_delay_ -= ahead_;
  for (double& delay : recent_) {
    delay -= ahead_;
  }
  ahead_ = 0.0;
}

void SensorClock::set(double ahead) {
  ++steps_;
  set_ = last_->arrival;
  other_ = ahead_;
  ahead_ = ahead;
  delays_.clear();
}

void SensorClock::restart(const Message& message) {
  recent_ = {message.delay()};
  intervals_.clear();
  delays_.clear();
  other_.reset();
  set_back_.reset();
  jumped_.reset();
  ahead_ = 0.0;
  last_ = message;
  min_delay_ = message.delay();
}

}  // namespace datmo
