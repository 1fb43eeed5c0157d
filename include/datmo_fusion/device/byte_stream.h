// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace datmo {

/// Where a device's bytes come from, one after the other.
class ByteStream {
 public:
  virtual ~ByteStream() = default;

  /// What has come, at least one byte. Throws DeviceError (`silent_device`, `lost_connection`),
  /// DeviceStopped.
  virtual std::string receive() = 0;
};

/// A device that takes commands, too.
class CommandStream : public ByteStream {
 public:
  /// Throws DeviceError (`lost_connection`), DeviceStopped.
  virtual void send(std::string_view bytes) = 0;
};

}  // namespace datmo
