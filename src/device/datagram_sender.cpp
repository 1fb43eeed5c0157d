// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/datagram_sender.h"

#include <cerrno>
#include <cstring>
#include <exception>
#include <utility>

#include "ipv4_address.h"
#include <sys/socket.h>
#include <unistd.h>

namespace datmo {

namespace {

/// How long a datagram waits for the look-up that it begins: an address, and a name that is known,
/// are looked up within this time.
constexpr std::chrono::milliseconds kPatience(50);

}  // namespace

DatagramSender::DatagramSender(const std::string& host, int port)
    : name_(host + ":" + std::to_string(port)) {
  const sockaddr_in address = ipv4Address(host, port);
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int allowed = 1;
  setsockopt(socket_, SOL_SOCKET, SO_BROADCAST, &allowed, sizeof allowed);
  if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    const int error = errno;
    close(socket_);
    throw DeviceError("no_connection", "no datagram can be sent to " + name_ + " (" +
                                           std::strerror(error) + "): expected a route to it");
  }
}

DatagramSender::~DatagramSender() { close(socket_); }

void DatagramSender::send(std::string_view bytes) const {
  // If nobody listened to an earlier datagram, the next one reports it; then it is sent again.
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) >= 0) {
      return;
    }
    if (errno != ECONNREFUSED) {
      throw DeviceError("not_sent", "a datagram of " + std::to_string(bytes.size()) + " bytes to " +
                                        name_ + " was not sent (" + std::strerror(errno) + ")");
    }
  }
}

DatagramDestination::DatagramDestination(const std::string& host, int port, double pause)
    : has_host_(!host.empty()),
      pause_(pause),
      look_up_([host, port] { return lookUp(host, port); }) {}

DatagramDestination::LookedUp DatagramDestination::lookUp(const std::string& host, int port) {
  try {
    return std::make_unique<DatagramSender>(host, port);
  } catch (const DeviceError& error) {
    return error;
  } catch (const std::exception& error) {  // out of memory
    return DeviceError("internal_error", error.what());
  }
}

std::optional<DatagramDestination::LookedUp> DatagramDestination::result() {
  std::optional<LookedUp> found = look_up_.take();
  // The pause begins when a look-up has failed, since that may take longer than the pause.
  const bool is_paused = failed_ && Clock::now() - *failed_ < pause_;
  if (!found && !is_paused && look_up_.start()) {
    look_up_.waitFor(kPatience);
    found = look_up_.take();
  }
  return found;
}

bool DatagramDestination::send(std::string_view bytes) {
  if (!has_host_) {
    return false;
  }
  if (!sender_) {
    std::optional<LookedUp> found = result();
    if (!found) {
      return false;
    }
    if (const auto* const error = std::get_if<DeviceError>(&*found)) {
      failed_ = Clock::now();
      throw DeviceError(*error);
    }
    sender_ = std::get<std::unique_ptr<DatagramSender>>(std::move(*found));
  }
  sender_->send(bytes);
  return true;
}

}  // namespace datmo
