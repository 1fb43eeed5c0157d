// SPDX-License-Identifier: BSD-3-Clause
#include "device/fake_server.h"

#include <array>
#include <stdexcept>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace datmo::samples {

namespace {

constexpr time_t kPatience = 60;  // s: far more than a busy machine needs

void bePatient(int socket) {
  const timeval patience{kPatience, 0};
  setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
}

/// Binds a socket to a port of loopback, 0: a free one; returns the port, negative on failure.
int bound(int socket, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  const bool fails = bind(socket, any, size) != 0 || getsockname(socket, any, &size) != 0;
  return fails ? -1 : ntohs(address.sin_port);
}

}  // namespace

UnusedPort::UnusedPort()
    : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)), port_(bound(socket_, 0)) {}

UnusedPort::~UnusedPort() { ::close(socket_); }

FakeServer::FakeServer(int port) {
  listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  bePatient(listener_);
  port_ = bound(listener_, port);
  if (port_ < 0 || listen(listener_, 1) != 0) {
    throw std::runtime_error("no port for the fake device");
  }
}

FakeServer::~FakeServer() {
  close();
  ::close(listener_);
}

void FakeServer::accept() {
  close();
  client_ = ::accept(listener_, nullptr, nullptr);
  if (client_ < 0) {
    throw std::runtime_error("nobody connects to the fake device");
  }
  bePatient(client_);
  const int on = 1;  // otherwise a measurement may wait until the previous one is acknowledged
  setsockopt(client_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

bool FakeServer::receiveMore() {
  std::array<char, 256> bytes;
  const ssize_t count = recv(client_, bytes.data(), bytes.size(), 0);
  received_.append(bytes.data(), static_cast<std::size_t>(count > 0 ? count : 0));
  return count > 0;
}

std::string FakeServer::receive(char end) {
  while (received_.find(end) == std::string::npos) {
    if (!receiveMore()) {
      return "";
    }
  }
  const std::string line = received_.substr(0, received_.find(end));
  received_.erase(0, line.size() + 1);
  return line;
}

std::string FakeServer::receiveBytes(std::size_t count) {
  while (received_.size() < count) {
    if (!receiveMore()) {
      return "";
    }
  }
  const std::string bytes = received_.substr(0, count);
  received_.erase(0, count);
  return bytes;
}

void FakeServer::send(const std::string& bytes) const {
  ::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
}

void FakeServer::close() {
  if (client_ >= 0) {
    ::close(client_);
  }
  client_ = -1;
  received_.clear();
}

}  // namespace datmo::samples
