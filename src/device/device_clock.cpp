// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/device_clock.h"

#include <cmath>

namespace datmo {

void DeviceClock::restart(const TickFormat& format) {
  format_ = format;
  estimator_.restart();
  has_message_ = false;
  interval_ = 0.0;
}

Stamp DeviceClock::add(std::uint64_t ticks, double delay) {
  const Stamp arrival = now_();
  const std::uint64_t step =
      has_message_ ? (ticks + format_.count - last_ticks_) % format_.count : 0;
  elapsed_ = has_message_ ? elapsed_ + step : ticks;
  last_ticks_ = ticks;
  const std::uint64_t steps_before = estimator_.steps();
  const double device = static_cast<double>(elapsed_) * format_.seconds;
  const Stamp sent = estimator_.add(device + delay, arrival);
  const bool is_new = !has_message_ || estimator_.steps() != steps_before;
  interval_ = is_new ? 0.0 : static_cast<double>(step) * format_.seconds;
  has_message_ = true;
  if (arrival <= Stamp()) {
    // The computer's time stands at 0: simulated time has not begun. When it begins, that is no
    // delay of a message.
    estimator_.restart();
  }
  return sent + -delay;
}

double DeviceClock::sinceLast(std::uint64_t ticks) const {
  const std::uint64_t step = (ticks + format_.count - last_ticks_) % format_.count;
  const auto after = static_cast<double>(step);
  const auto all = static_cast<double>(format_.count);
  return (after <= all / 2.0 ? after : after - all) * format_.seconds;
}

ClockState DeviceClock::state() const {
  return {estimator_.offset().value_or(0.0), estimator_.drift(), estimator_.steps()};
}

std::uint64_t missedIn(double interval, double period) {
  const double turns = std::round(interval / period);
  return turns > 1.0 ? static_cast<std::uint64_t>(turns) - 1 : 0;
}

}  // namespace datmo
