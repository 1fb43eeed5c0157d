// SPDX-License-Identifier: BSD-3-Clause
#include "device/fake_scanner.h"

#include <array>
#include <stdexcept>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "datmo_fusion/device/scip.h"

namespace datmo::samples {

namespace {

constexpr time_t kPatience = 60;  // s: far more than a busy machine needs
constexpr std::size_t kLineLength = 64;

std::string encoded(std::uint32_t value, int characters) {
  std::string text;
  for (int i = characters - 1; i >= 0; --i) {
    text += static_cast<char>(((value >> (6 * i)) & 0x3FU) + '0');
  }
  return text;
}

std::string checked(const std::string& line) { return line + scipChecksum(line) + "\n"; }

}  // namespace

const std::vector<std::string> FakeScanner::kModel{"MODL:UST-10LX", "DMIN:20",  "DMAX:30000",
                                                   "ARES:16",       "AMIN:6",   "AMAX:10",
                                                   "AFRT:8",        "SCAN:2400"};

FakeScanner::FakeScanner(int port) {
  listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  const timeval patience{kPatience, 0};
  setsockopt(listener_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  if (bind(listener_, any, size) != 0 || listen(listener_, 1) != 0 ||
      getsockname(listener_, any, &size) != 0) {
    throw std::runtime_error("no port for the fake scanner");
  }
  port_ = ntohs(address.sin_port);
}

FakeScanner::~FakeScanner() {
  close();
  ::close(listener_);
}

void FakeScanner::accept() {
  close();
  client_ = ::accept(listener_, nullptr, nullptr);
  if (client_ < 0) {
    throw std::runtime_error("nobody connects to the fake scanner");
  }
  const timeval patience{kPatience, 0};
  setsockopt(client_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
}

std::string FakeScanner::command() {
  std::array<char, 256> bytes;
  while (heard_.find('\n') == std::string::npos) {
    const ssize_t count = recv(client_, bytes.data(), bytes.size(), 0);
    if (count <= 0) {
      return "";
    }
    heard_.append(bytes.data(), static_cast<std::size_t>(count));
  }
  const std::size_t end = heard_.find('\n');
  const std::string line = heard_.substr(0, end);
  heard_.erase(0, end + 1);
  return line;
}

void FakeScanner::shakeHands(const std::vector<std::string>& model) {
  for (std::string asked = command(); !asked.empty(); asked = command()) {
    answer(asked, "00", asked == "PP" ? model : std::vector<std::string>());
    if (asked.rfind("MD", 0) == 0) {
      return;
    }
  }
}

void FakeScanner::answer(const std::string& command, const std::string& status,
                         const std::vector<std::string>& lines) {
  std::string text = command + "\n" + checked(status);
  for (const std::string& line : lines) {
    text += line + ";" + scipChecksum(line) + "\n";
  }
  send(text + "\n");
}

std::string FakeScanner::scan(std::uint32_t clock, const std::vector<std::uint32_t>& ranges) {
  std::string text = "MD0006001001000\n" + checked("99") + checked(encoded(clock, 4));
  std::string data;
  for (const std::uint32_t range : ranges) {
    data += encoded(range, 3);
  }
  for (std::size_t i = 0; i < data.size(); i += kLineLength) {
    text += checked(data.substr(i, kLineLength));
  }
  return text + "\n";
}

void FakeScanner::send(const std::string& bytes) const {
  ::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
}

void FakeScanner::close() {
  if (client_ >= 0) {
    ::close(client_);
  }
  client_ = -1;
  heard_.clear();
}

}  // namespace datmo::samples
