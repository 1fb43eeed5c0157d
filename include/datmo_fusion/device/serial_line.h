// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <string>
#include <string_view>

#include "datmo_fusion/device/byte_stream.h"

namespace datmo {

struct SerialSettings {
  std::string file;       ///< "/dev/ttyUSB0"
  int baud = 9600;        ///< bits per second, a rate that the system supports
  double timeout = 1.0;   ///< s
  bool commands = false;  ///< whether anything is sent to it
};

/// A serial port (8 data bits, no parity, 1 stop bit), for the thread that serves it; also a pipe,
/// which has no such settings, and a USB scanner, which needs none. POSIX only.
class SerialLine : public CommandStream {
 public:
  /// `stop`: true ends all waiting; must outlive the line. Throws DeviceError (`no_connection`).
  SerialLine(SerialSettings settings, const std::atomic<bool>& stop);
  ~SerialLine() override;
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  void send(std::string_view bytes) override;
  std::string receive() override;

 private:
  void configure() const;

  SerialSettings settings_;
  const std::atomic<bool>& stop_;
  int file_ = -1;
};

}  // namespace datmo
