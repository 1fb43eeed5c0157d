// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/datagram_sender.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include "ipv4_address.h"
#include <sys/socket.h>
#include <unistd.h>

#include "datmo_fusion/device/device_error.h"

namespace datmo {

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

DatagramDestination::DatagramDestination(std::string host, int port, double pause)
    : host_(std::move(host)), port_(port), pause_(pause) {}

bool DatagramDestination::send(std::string_view bytes) {
  if (!sender_) {
    const Clock::time_point now = Clock::now();
    if (host_.empty() || (looked_up_ && now - *looked_up_ < pause_)) {
      return false;
    }
    looked_up_ = now;
    sender_.emplace(host_, port_);
  }
  sender_->send(bytes);
  return true;
}

}  // namespace datmo
