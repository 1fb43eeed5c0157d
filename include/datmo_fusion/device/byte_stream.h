// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace datmo {

/// Stream of bytes from a device.
class ByteStream {
 public:
  virtual ~ByteStream() = default;

  /// Waits for bytes and returns them, at least one. Throws DeviceError (`silent_device`,
  /// `lost_connection`), DeviceStopped.
  virtual std::string receive() = 0;
};

/// Stream of a device that also accepts commands.
class CommandStream : public ByteStream {
 public:
  /// Throws DeviceError (`lost_connection`), DeviceStopped.
  virtual void send(std::string_view bytes) = 0;
};

}  // namespace datmo
