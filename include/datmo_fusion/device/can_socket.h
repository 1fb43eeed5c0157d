// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "datmo_fusion/device/can_frame.h"

namespace datmo {

/// The frames that come to a CAN interface of Linux (SocketCAN, a raw socket), with the kernel's
/// time of their reception. Error frames come, too; nothing is ever sent.
class CanSocket : public CanSource {
 public:
  /// Of an interface, "can0". `timeout`: s, of silence. `stop`: true ends all waiting; must outlive
  /// the socket. Throws DeviceError (`no_connection`, `interface_down`).
  static std::unique_ptr<CanSocket> open(const std::string& interface, double timeout,
                                         const std::atomic<bool>& stop);

  /// Of a socket whose datagrams are frames as the kernel has them (struct can_frame, canfd_frame),
  /// which is closed with it.
  CanSocket(int descriptor, std::string name, double timeout, const std::atomic<bool>& stop);
  ~CanSocket() override;
  CanSocket(const CanSocket&) = delete;
  CanSocket& operator=(const CanSocket&) = delete;

  /// Throws DeviceError (`silent_device`, `interface_down`, `lost_connection`), CanFrameError,
  /// DeviceStopped.
  CanFrame next() override;

 private:
  /// False: nothing has come.
  bool read(CanFrame& frame);

  int socket_;
  std::string name_;
  double timeout_;  ///< s
  const std::atomic<bool>& stop_;
  std::uint32_t overflow_ = 0;  ///< frames that the kernel had no room for, so far
};

}  // namespace datmo
