// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/playback_clock.h"

#include <algorithm>
#include <thread>

#include "datmo_fusion/device/device_error.h"

namespace datmo {

void PlaybackClock::waitUntil(double recorded) {
  constexpr std::chrono::milliseconds kSlice(50);  // latency of stopping
  start_ = start_.value_or(Start{recorded, Clock::now()});
  const auto due = start_->played + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(recorded - start_->recorded));
  while (!stop_ && Clock::now() < due) {
    std::this_thread::sleep_until(std::min<Clock::time_point>(due, Clock::now() + kSlice));
  }
  if (stop_) {
    throw DeviceStopped();
  }
}

}  // namespace datmo
