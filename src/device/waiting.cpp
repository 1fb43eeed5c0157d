// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/waiting.h"

#include <chrono>

#include <poll.h>

namespace datmo {

bool waitForEvents(int descriptor, short events, double timeout, const std::atomic<bool>& stop) {
  constexpr int kSlice = 50;  // ms, latency of stopping
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(timeout);
  while (!stop && Clock::now() < end) {
    pollfd watched{descriptor, events, 0};
    if (poll(&watched, 1, kSlice) > 0) {
      return true;
    }
  }
  return false;
}

}  // namespace datmo
