// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/connection.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "datmo_fusion/device/device_error.h"
#include "datmo_fusion/device/waiting.h"

namespace datmo {

namespace {

std::string nameOf(const DeviceAddress& address) {
  return address.host + ":" + std::to_string(address.port);
}

DeviceError noConnection(const DeviceAddress& address, const std::string& cause) {
  return {"no_connection", "no connection to " + nameOf(address) + " (" + cause +
                               "): expected a device there; is it on, and is the address right?"};
}

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

Addresses lookUp(const DeviceAddress& address) {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const std::string port = std::to_string(address.port);
  const int error = getaddrinfo(address.host.c_str(), port.c_str(), &wanted, &found);
  if (error != 0) {
    throw noConnection(address, gai_strerror(error));
  }
  return {found, &freeaddrinfo};
}

}  // namespace

Connection::Connection(const DeviceAddress& address, const std::atomic<bool>& stop)
    : address_(address), stop_(stop) {
  const Addresses found = lookUp(address);
  int error = 0;
  for (const addrinfo* one = found.get(); one != nullptr && socket_ < 0; one = one->ai_next) {
    error = connectTo(*one);
  }
  if (socket_ < 0 && stop_) {
    throw DeviceStopped();
  }
  if (socket_ < 0) {
    throw noConnection(address, std::strerror(error));
  }
  const int on = 1;
  setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

int Connection::connectTo(const addrinfo& found) {
  socket_ = socket(found.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  int error = socket_ < 0 ? errno : 0;
  if (error == 0 && connect(socket_, found.ai_addr, found.ai_addrlen) != 0) {
    error = errno;
    if (error == EINPROGRESS) {
      socklen_t size = sizeof error;
      error = ETIMEDOUT;
      if (waitForEvents(socket_, POLLOUT, address_.timeout, stop_)) {
        getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size);
      }
    }
  }
  if (error != 0 && socket_ >= 0) {
    close(socket_);
    socket_ = -1;
  }
  return error;
}

Connection::~Connection() { close(socket_); }

void Connection::send(std::string_view bytes) {
  // A command is far shorter than what a socket accepts at once.
  const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (sent != static_cast<ssize_t>(bytes.size())) {
    throw DeviceError("lost_connection", nameOf(address_) + " does not accept a command (" +
                                             std::strerror(errno) + "): reconnecting");
  }
}

std::string Connection::receive() {
  if (!waitForEvents(socket_, POLLIN, address_.timeout, stop_)) {
    if (stop_) {
      throw DeviceStopped();
    }
    throw DeviceError("silent_device", nameOf(address_) + " has been silent for " +
                                           std::to_string(address_.timeout) +
                                           " s: expected an answer or measurements; reconnecting");
  }
  constexpr std::size_t kAtOnce = 16384;
  std::array<char, kAtOnce> bytes;
  const ssize_t count = recv(socket_, bytes.data(), bytes.size(), 0);
  if (count <= 0) {
    throw DeviceError("lost_connection",
                      nameOf(address_) + " has closed the connection" +
                          (count < 0 ? " (" + std::string(std::strerror(errno)) + ")" : "") +
                          ": reconnecting");
  }
  return {bytes.data(), static_cast<std::size_t>(count)};
}

}  // namespace datmo
