// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace datmo {

/// Sends datagrams (UDP, IPv4) to one address, which may be a broadcast address. POSIX only.
class DatagramSender {
 public:
  /// Throws DeviceError (`no_connection`).
  DatagramSender(const std::string& host, int port);
  ~DatagramSender();
  DatagramSender(const DatagramSender&) = delete;
  DatagramSender& operator=(const DatagramSender&) = delete;

  /// Sends without waiting; whether anybody listens there is not checked. Throws DeviceError
  /// (`not_sent`).
  void send(std::string_view bytes) const;

 private:
  std::string name_;
  int socket_ = -1;
};

/// The same for a host whose name is looked up when something is first sent: that may take a while,
/// so it is only tried again after a pause if it fails.
class DatagramDestination {
 public:
  /// An empty host: no destination. `pause`: s.
  DatagramDestination(std::string host, int port, double pause);

  /// Returns whether it was sent: not without a destination, and not during the pause. Throws
  /// DeviceError (`no_connection`, `not_sent`).
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
