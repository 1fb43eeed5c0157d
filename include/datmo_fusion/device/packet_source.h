// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace datmo {

/// Source of a device's datagrams.
class PacketSource {
 public:
  virtual ~PacketSource() = default;

  /// Waits for the next datagram's data, which are valid until the next call. Throws DeviceError,
  /// DeviceStopped.
  virtual std::string_view next() = 0;
};

}  // namespace datmo
