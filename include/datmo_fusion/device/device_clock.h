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
  std::uint64_t count = 0;  ///< it begins again at 0 after so many
};

/// What is known of a device's clock.
struct ClockState {
  double offset = 0.0;      ///< s, the computer's time minus the device's
  double drift = 0.0;       ///< s/s; positive: the device's clock is slow
  std::uint64_t steps = 0;  ///< how often one of the two was set
};

/// The ticks that come in a device's messages as the computer's time (ClockEstimator), also where
/// they begin again.
class DeviceClock {
 public:
  /// `now`: the computer's time, for arrivals. Throws OptionError.
  DeviceClock(const Checked<ClockOptions>& options, std::function<Stamp()> now)
      : estimator_(options), now_(std::move(now)) {}

  /// Another connection: the device may have been switched off.
  void restart(const TickFormat& format);

  /// A message has come that says `ticks`, and was sent `delay` (s) after them. Returns when the
  /// device's clock said so, on the computer's.
  Stamp add(std::uint64_t ticks, double delay = 0.0);

  /// Device time from the message before the last one to the last, s; 0 where one of the two does
  /// not exist, or a clock was set between them.
  double interval() const { return interval_; }

  /// Device time from a message to one with `ticks`, s, of half the clock's range at most: negative
  /// if it is from before it.
  double sinceLast(std::uint64_t ticks) const;

  bool hasMessage() const { return has_message_; }

  /// The computer's time.
  Stamp now() const { return now_(); }

  ClockState state() const;

 private:
  ClockEstimator estimator_;
  std::function<Stamp()> now_;
  TickFormat format_;
  std::uint64_t last_ticks_ = 0;  ///< as they come
  std::uint64_t elapsed_ = 0;     ///< ticks since the clock was 0 for the first time
  double interval_ = 0.0;         ///< s
  bool has_message_ = false;      ///< of this connection
};

/// Measurements of a device that are missing in `interval` (s), of which there should be one each
/// `period` (s, more than 0).
std::uint64_t missedIn(double interval, double period);

}  // namespace datmo
