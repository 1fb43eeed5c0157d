// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/datagram_socket.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>

#include "ipv4_address.h"
#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "datmo_fusion/device/device_error.h"
#include "datmo_fusion/device/waiting.h"

namespace datmo {

namespace {

/// Maximum number of bytes that wait while the thread is delayed: half a second of 1.3 million
/// points per second. The system may allow less (net.core.rmem_max).
constexpr int kWaitingBytes = 4 * 1024 * 1024;

}  // namespace

DatagramSocket::DatagramSocket(const DeviceAddress& device, const std::atomic<bool>& stop)
    : device_(device), stop_(stop) {
  if (!device.host.empty()) {
    sender_ = ipv4Address(device.host, device.port).sin_addr.s_addr;
  }
  open();
}

DatagramSocket::~DatagramSocket() { close(socket_); }

void DatagramSocket::open() {
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &kWaitingBytes, sizeof kWaitingBytes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  address.sin_port = htons(static_cast<std::uint16_t>(device_.port));
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    const int error = errno;
    close(socket_);
    throw DeviceError("no_connection", "UDP port " + std::to_string(device_.port) +
                                           " cannot be opened (" + std::strerror(error) +
                                           "): expected that no other driver uses it");
  }
}

std::string_view DatagramSocket::next() {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(device_.timeout);
  do {
    sockaddr_in from{};
    socklen_t size = sizeof from;
    const ssize_t count = recvfrom(socket_, bytes_.data(), bytes_.size(), 0,
                                   reinterpret_cast<sockaddr*>(&from), &size);
    if (count >= 0 && (!sender_ || from.sin_addr.s_addr == *sender_)) {
      return {bytes_.data(), static_cast<std::size_t>(count)};
    }
    if (count < 0 && errno != EAGAIN && errno != EINTR) {
      throw DeviceError("lost_connection", "UDP port " + std::to_string(device_.port) + " fails (" +
                                               std::strerror(errno) + "): reopening it");
    }
    const std::chrono::duration<double> left = end - Clock::now();
    if (count < 0) {
      waitForEvents(socket_, POLLIN, left.count(), stop_);
    }
    if (stop_) {
      throw DeviceStopped();
    }
  } while (Clock::now() < end);
  throw DeviceError("silent_device",
                    "no packet on UDP port " + std::to_string(device_.port) + " from " +
                        (device_.host.empty() ? "anybody" : device_.host) + " for " +
                        std::to_string(device_.timeout) +
                        " s: is the device on, and are its packets sent to this computer?");
}

}  // namespace datmo
