// SPDX-License-Identifier: BSD-3-Clause
#include "device/fake_server.h"

#include <array>
#include <stdexcept>

#include <arpa/inet.h>
#include <netinet/in.h>
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

}  // namespace

FakeServer::FakeServer(int port) {
  listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  bePatient(listener_);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  if (bind(listener_, any, size) != 0 || listen(listener_, 1) != 0 ||
      getsockname(listener_, any, &size) != 0) {
    throw std::runtime_error("no port for the fake device");
  }
  port_ = ntohs(address.sin_port);
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
}

std::string FakeServer::receive(char end) {
  std::array<char, 256> bytes;
  while (heard_.find(end) == std::string::npos) {
    const ssize_t count = recv(client_, bytes.data(), bytes.size(), 0);
    if (count <= 0) {
      return "";
    }
    heard_.append(bytes.data(), static_cast<std::size_t>(count));
  }
  const std::size_t length = heard_.find(end);
  const std::string line = heard_.substr(0, length);
  heard_.erase(0, length + 1);
  return line;
}

void FakeServer::send(const std::string& bytes) const {
  ::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
}

void FakeServer::close() {
  if (client_ >= 0) {
    ::close(client_);
  }
  client_ = -1;
  heard_.clear();
}

}  // namespace datmo::samples
