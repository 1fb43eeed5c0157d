// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "datmo_fusion/device/can_frame.h"

namespace datmo {

/// Receives the frames of a Linux CAN interface (SocketCAN, a raw socket), with the kernel's time
/// of reception, including error frames; never sends anything.
class CanSocket : public CanSource {
 public:
  /// Opens an interface, "can0". `timeout`: s, of silence. `stop`: true ends all waiting; must
  /// outlive the socket. Throws DeviceError (`no_connection`, `interface_down`).
  static std::unique_ptr<CanSocket> open(const std::string& interface, double timeout,
                                         const std::atomic<bool>& stop);

  /// Takes ownership of a socket whose datagrams are frames of the kernel (struct can_frame,
  /// canfd_frame).
  CanSocket(int descriptor, std::string name, double timeout, const std::atomic<bool>& stop);
  ~CanSocket() override;
  CanSocket(const CanSocket&) = delete;
  CanSocket& operator=(const CanSocket&) = delete;

  /// Throws DeviceError (`silent_device`, `interface_down`, `lost_connection`), CanFrameError,
  /// DeviceStopped.
  CanFrame next() override;

 private:
  /// Returns false if nothing has been received.
  bool read(CanFrame& frame);

  int socket_;
  std::string name_;
  double timeout_;  ///< s
  const std::atomic<bool>& stop_;
  std::uint32_t overflow_ = 0;  ///< frames that the kernel has dropped so far
};

}  // namespace datmo
