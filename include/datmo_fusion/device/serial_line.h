// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <string>

#include "datmo_fusion/device/byte_stream.h"

namespace datmo {

struct SerialSettings {
  std::string file;      ///< "/dev/ttyUSB0"
  int baud = 9600;       ///< bits per second, one that the system has a name for
  double timeout = 1.0;  ///< s
};

/// A serial port (8 data bits, no parity, 1 stop bit), for the thread that serves it; also a pipe,
/// which has no such settings. POSIX alone.
class SerialLine : public ByteStream {
 public:
  /// `stop`: true ends all waiting; must outlive the line. Throws DeviceError (`no_connection`).
  SerialLine(SerialSettings settings, const std::atomic<bool>& stop);
  ~SerialLine() override;
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  std::string receive() override;

 private:
  void configure() const;

  SerialSettings settings_;
  const std::atomic<bool>& stop_;
  int file_ = -1;
};

}  // namespace datmo
