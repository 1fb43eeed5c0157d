// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
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

/// The same to a host whose name is looked up when something is first sent: that may take a while,
/// so where it fails it is tried again after a pause only.
class DatagramDestination {
 public:
  /// An empty host is nobody. `pause`: s.
  DatagramDestination(std::string host, int port, double pause);

  /// Whether it was sent: not to nobody, and not during the pause. Throws DeviceError
  /// (`no_connection`, `not_sent`).
  bool send(std::string_view bytes);

 private:
  using Clock = std::chrono::steady_clock;

  std::string host_;
  int port_;
  std::chrono::duration<double> pause_;
  std::optional<DatagramSender> sender_;
  std::optional<Clock::time_point> looked_up_;
};

}  // namespace datmo
