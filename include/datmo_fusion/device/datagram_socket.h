// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

#include "datmo_fusion/device/connection.h"
#include "datmo_fusion/device/packet_source.h"

namespace datmo {

/// Receives datagrams at a UDP port (IPv4), from one device or from any. POSIX only.
class DatagramSocket : public PacketSource {
 public:
  /// `device`: the port and the sender; without a host, any sender. `stop`: true ends all waiting;
  /// must outlive the socket. Throws DeviceError (`no_connection`).
  DatagramSocket(const DeviceAddress& device, const std::atomic<bool>& stop);
  ~DatagramSocket() override;
  DatagramSocket(const DatagramSocket&) = delete;
  DatagramSocket& operator=(const DatagramSocket&) = delete;

  /// Throws DeviceError (`silent_device`, `lost_connection`), DeviceStopped.
  std::string_view next() override;

 private:
  void open();

  static constexpr std::size_t kLongest = 2048;  ///< longer ones are truncated

  DeviceAddress device_;
  const std::atomic<bool>& stop_;
  std::optional<std::uint32_t> sender_;  ///< address in network byte order; none: any sender
  int socket_ = -1;
  std::array<char, kLongest> bytes_{};
};

}  // namespace datmo
