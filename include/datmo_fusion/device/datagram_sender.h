// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace datmo {

/// Sends datagrams (UDP, IPv4) to one address, which may be a broadcast one. POSIX alone.
class DatagramSender {
 public:
  /// Throws DeviceError (`no_connection`).
  DatagramSender(const std::string& host, int port);
  ~DatagramSender();
  DatagramSender(const DatagramSender&) = delete;
  DatagramSender& operator=(const DatagramSender&) = delete;

  /// Without waiting; that nobody listens there is not found out. Throws DeviceError
  /// (`not_sent`).
  void send(std::string_view bytes) const;

 private:
  std::string name_;
  int socket_ = -1;
};

}  // namespace datmo
