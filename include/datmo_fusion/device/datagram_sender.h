// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "datmo_fusion/common/background_call.h"
#include "datmo_fusion/device/device_error.h"

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

/// The same for a host whose name is looked up when something is first sent: that may take minutes,
/// so it happens in a thread of its own, and is only tried again after a pause if it fails.
class DatagramDestination {
 public:
  /// An empty host: no destination. `pause`: s.
  DatagramDestination(const std::string& host, int port, double pause);

  /// Returns whether it was sent: not without a destination, not while its name is being looked up
  /// for longer than usual, and not during the pause. Throws DeviceError (`no_connection`, with the
  /// first datagram after a look-up has failed; `not_sent`).
  bool send(std::string_view bytes);

 private:
  using Clock = std::chrono::steady_clock;
  using LookedUp = std::variant<std::unique_ptr<DatagramSender>, DeviceError>;

  static LookedUp lookUp(const std::string& host, int port);
  /// Returns a new result of looking up the name, which is begun if that is due; none: there is
  /// none yet.
  std::optional<LookedUp> result();

  bool has_host_;
  std::chrono::duration<double> pause_;
  BackgroundCall<LookedUp> look_up_;
  std::unique_ptr<DatagramSender> sender_;   ///< null: not looked up yet
  std::optional<Clock::time_point> failed_;  ///< when the last look-up failed
};

}  // namespace datmo
