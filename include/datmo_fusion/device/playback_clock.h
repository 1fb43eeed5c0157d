// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <optional>

namespace datmo {

/// Paces the playback of a recording: each part is played when it is due, or at once if it is
/// overdue.
class PlaybackClock {
 public:
  /// `stop`: true ends all waiting; must outlive the clock.
  explicit PlaybackClock(const std::atomic<bool>& stop) : stop_(stop) {}

  /// Waits until what was recorded at this time (s) is due; the first call sets the pace. Throws
  /// DeviceStopped.
  void waitUntil(double recorded);

  /// The next part is due at once, and sets the pace again.
  void restart() { start_.reset(); }

 private:
  using Clock = std::chrono::steady_clock;

  /// Time of the first part of a recording, on both clocks.
  struct Start {
    double recorded;  ///< s
    Clock::time_point played;
  };

  const std::atomic<bool>& stop_;
  std::optional<Start> start_;
};

}  // namespace datmo
