// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "datmo_fusion/device/can_frame.h"
#include "datmo_fusion/device/playback_clock.h"

namespace datmo {

/// A line of a log.
struct LoggedCanFrame {
  double time = 0.0;  ///< s, when it was received
  std::string interface;
  CanFrame frame;
};

/// Parses a line as `candump -L` of can-utils writes it: `(1436509052.249713) can0 1A0#2A366C2B`;
/// `##` and a digit of flags in place of `#` for CAN FD. None for an empty line or a remote frame,
/// which has no data. Throws CanFrameError.
std::optional<LoggedCanFrame> canLogLine(std::string_view line);

/// The frames of one interface, or of all, in a log of `candump -L`, played at the rate at which
/// they were received.
class CanLog : public CanSource {
 public:
  /// `interface`: "can0"; empty: all. `stop`: true ends all waiting; must outlive the log. Throws
  /// DeviceError (`bad_recording`).
  CanLog(std::string file, std::string interface, const std::atomic<bool>& stop);

  /// Throws RecordingEnd, CanFrameError, DeviceStopped.
  CanFrame next() override;

 private:
  std::string file_;
  std::string interface_;
  std::ifstream stream_;
  PlaybackClock pace_;
  std::string other_interface_;  ///< of a frame that was ignored; empty: none was
  double last_ = 0.0;            ///< s, of the last line
  std::uint64_t lines_ = 0;      ///< so far
};

}  // namespace datmo
