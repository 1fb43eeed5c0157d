// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/device/clock_estimator.h"

namespace datmo {

/// How a device counts time.
struct TickFormat {
  double seconds = 1e-6;    ///< s, of one tick
  std::uint64_t count = 0;  ///< it restarts at 0 after this many
};

/// Estimated state of a device's clock.
struct ClockState {
  double offset = 0.0;      ///< s, the computer's time minus the device's
  double drift = 0.0;       ///< s/s; positive: the device's clock is slow
  std::uint64_t steps = 0;  ///< how often one of the two was set
};

/// Converts the ticks in a device's messages to the computer's time (ClockEstimator), across
/// wraparounds.
class DeviceClock {
 public:
  /// `now`: the computer's time, for arrivals. Throws OptionError.
  DeviceClock(const Checked<ClockOptions>& options, std::function<Stamp()> now)
      : estimator_(options), now_(std::move(now)) {}

  /// Starts a new connection: the device may have been switched off.
  void restart(const TickFormat& format);

  /// Adds a received message with `ticks` that was sent `delay` (s) after them. Returns the time of
  /// the ticks on the computer's clock.
  Stamp add(std::uint64_t ticks, double delay = 0.0);

  /// Returns the device time between the last two messages, s; 0 if there are fewer than two, or a
  /// clock was set between them.
  double interval() const { return interval_; }

  /// Returns the device time from the last message to one with `ticks`, s, at most half the clock's
  /// range: negative if the latter is older.
  double sinceLast(std::uint64_t ticks) const;

  bool hasMessage() const { return has_message_; }

  /// Returns the computer's time.
  Stamp now() const { return now_(); }

  ClockState state() const;

 private:
  ClockEstimator estimator_;
  std::function<Stamp()> now_;
  TickFormat format_;
  std::uint64_t last_ticks_ = 0;  ///< as received
  std::uint64_t elapsed_ = 0;     ///< ticks since the clock was 0 for the first time
  double interval_ = 0.0;         ///< s
  bool has_message_ = false;      ///< of this connection
};

/// Returns the number of measurements missing in `interval` (s), if there should be one in each
/// `period` (s, more than 0).
std::uint64_t missedIn(double interval, double period);

}  // namespace datmo
