// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <string>
#include <string_view>

#include "datmo_fusion/device/byte_stream.h"

struct addrinfo;

namespace datmo {

/// Network address of a device, and how long it may be silent.
struct DeviceAddress {
  std::string host;
  int port = 0;
  double timeout = 1.0;  ///< s
};

/// A TCP connection to a device, for the thread that serves it. Except for the name lookup, which
/// the system limits, it never waits longer than the timeout for each address of the name. POSIX
/// only.
class Connection : public CommandStream {
 public:
  /// `stop`: true ends all waiting; must outlive the connection. Throws DeviceError
  /// (`no_connection`), DeviceStopped.
  Connection(const DeviceAddress& address, const std::atomic<bool>& stop);
  ~Connection() override;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void send(std::string_view bytes) override;
  std::string receive() override;

 private:
  /// Connects to one address of the name; sets the socket, or returns errno.
  int connectTo(const addrinfo& found);

  DeviceAddress address_;
  const std::atomic<bool>& stop_;
  int socket_ = -1;
};

}  // namespace datmo
