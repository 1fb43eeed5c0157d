// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "datmo_fusion/common/sensor_clock.h"

namespace datmo::sensor_clock_test {

constexpr double kPeriod = 0.06;  // s
constexpr int kMessages = 1000;
constexpr double kDelay = 0.02;  // s

struct Sent {
  double stamp;    // s
  double arrival;  // s
};

/// Changes a message that was measured at this time (s).
using Change = std::function<void(Sent& sent, double measured)>;

inline std::vector<Sent> sent(const Change& change, double period = kPeriod) {
  std::vector<Sent> messages;
  for (int i = 0; i < kMessages; ++i) {
    const double measured = 100.0 + period * i;
    messages.push_back({measured, measured + kDelay});
    change(messages.back(), measured);
  }
  return messages;
}

/// Returns the offsets that the clock finds, in the order of arrival; lost messages have none.
inline std::vector<double> found(std::vector<Sent> messages, SensorClock& clock) {
  messages.erase(std::remove_if(messages.begin(), messages.end(),
                                [](const Sent& one) { return std::isnan(one.arrival); }),
                 messages.end());
  std::stable_sort(messages.begin(), messages.end(),
                   [](const Sent& a, const Sent& b) { return a.arrival < b.arrival; });
  std::vector<double> ahead;
  for (const Sent& one : messages) {
    ahead.push_back(clock.add(Stamp::fromSeconds(one.stamp), Stamp::fromSeconds(one.arrival)));
  }
  return ahead;
}

inline bool isDuring(double measured) { return measured >= 110.0 && measured < 115.0; }

/// Offset (s, positive: ahead) at the message that was measured at this time.
inline double aheadAt(const std::vector<double>& ahead, double measured) {
  return ahead.at(static_cast<std::size_t>(std::lround((measured - 100.0) / kPeriod)));
}

}  // namespace datmo::sensor_clock_test
