// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <optional>

namespace datmo {

/// The pace of a recording that is played: each part when it is due, at once where that is past.
class PlaybackClock {
 public:
  /// `stop`: true ends all waiting; must outlive the clock.
  explicit PlaybackClock(const std::atomic<bool>& stop) : stop_(stop) {}

  /// Until what was recorded then (s) is due; the first call sets the pace. Throws DeviceStopped.
  void waitUntil(double recorded);

  /// What comes next is due at once, and sets the pace anew.
  void restart() { start_.reset(); }

 private:
  using Clock = std::chrono::steady_clock;

  /// What happens first of a recording, on both clocks.
  struct Start {
    double recorded;  ///< s
    Clock::time_point played;
  };

  const std::atomic<bool>& stop_;
  std::optional<Start> start_;
};

}  // namespace datmo
