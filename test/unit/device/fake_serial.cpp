// SPDX-License-Identifier: BSD-3-Clause
#include "device/fake_serial.h"

#include <array>
#include <cstdlib>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace datmo::samples {

FakeSerial::FakeSerial() : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
  if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) {
    throw std::runtime_error("no pseudo terminal for the fake device");
  }
  file_ = ptsname(master_);
}

FakeSerial::~FakeSerial() { close(master_); }

void FakeSerial::send(const std::string& bytes) const {
  if (write(master_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("the pseudo terminal takes nothing");
  }
}

std::string FakeSerial::receive(char end) {
  constexpr int kPatience = 60000;  // ms: far more than a busy machine needs
  std::array<char, 256> bytes;
  while (received_.find(end) == std::string::npos) {
    pollfd watched{master_, POLLIN, 0};
    const ssize_t count =
        poll(&watched, 1, kPatience) > 0 ? read(master_, bytes.data(), bytes.size()) : -1;
    if (count <= 0) {
      throw std::runtime_error("nothing comes through the pseudo terminal");
    }
    received_.append(bytes.data(), static_cast<std::size_t>(count));
  }
  const std::size_t length = received_.find(end);
  const std::string line = received_.substr(0, length);
  received_.erase(0, length + 1);
  return line;
}

speed_t FakeSerial::speed() const {
  termios line{};
  tcgetattr(master_, &line);
  return cfgetispeed(&line);
}

}  // namespace datmo::samples
