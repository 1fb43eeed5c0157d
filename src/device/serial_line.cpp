// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/serial_line.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include "datmo_fusion/device/device_error.h"
#include "datmo_fusion/device/waiting.h"

namespace datmo {

namespace {

struct BaudName {
  int baud;
  speed_t name;
};
constexpr std::array<BaudName, 8> kBauds = {{{4800, B4800},
                                             {9600, B9600},
                                             {19200, B19200},
                                             {38400, B38400},
                                             {57600, B57600},
                                             {115200, B115200},
                                             {230400, B230400},
                                             {460800, B460800}}};

constexpr int kOpenFlags = O_NOCTTY | O_NONBLOCK | O_CLOEXEC;

DeviceError noLine(const SerialSettings& settings, const std::string& cause) {
  return {"no_connection", "no device at " + settings.file + " (" + cause +
                               "): expected a serial port that this user may read" +
                               (settings.commands ? " and write" : "")};
}

}  // namespace

SerialLine::SerialLine(SerialSettings settings, const std::atomic<bool>& stop)
    : settings_(std::move(settings)),
      stop_(stop),
      file_(open(settings_.file.c_str(), (settings_.commands ? O_RDWR : O_RDONLY) | kOpenFlags)) {
  if (file_ < 0) {
    throw noLine(settings_, std::strerror(errno));
  }
  try {
    configure();
  } catch (const DeviceError&) {
    close(file_);
    throw;
  }
}

SerialLine::~SerialLine() { close(file_); }

void SerialLine::configure() const {
  termios line{};
  if (tcgetattr(file_, &line) != 0) {
    return;  // a pipe
  }
  const auto* const baud =
      std::find_if(kBauds.begin(), kBauds.end(),
                   [this](const BaudName& known) { return known.baud == settings_.baud; });
  if (baud == kBauds.end()) {
    throw noLine(settings_, std::to_string(settings_.baud) + " baud are not supported here");
  }
  cfmakeraw(&line);
  line.c_cflag |= CLOCAL | CREAD;
  line.c_cflag &= ~static_cast<tcflag_t>(CSTOPB);
  cfsetispeed(&line, baud->name);
  cfsetospeed(&line, baud->name);
  if (tcsetattr(file_, TCSANOW, &line) != 0) {
    throw noLine(settings_, std::strerror(errno));
  }
}

void SerialLine::send(std::string_view bytes) {
  while (!bytes.empty()) {
    if (!waitForEvents(file_, POLLOUT, settings_.timeout, stop_) && stop_) {
      throw DeviceStopped();
    }
    const ssize_t sent = write(file_, bytes.data(), bytes.size());
    if (sent <= 0) {
      throw DeviceError("lost_connection", settings_.file + " does not accept a command (" +
                                               std::strerror(errno) + "): reopening it");
    }
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
}

std::string SerialLine::receive() {
  if (!waitForEvents(file_, POLLIN, settings_.timeout, stop_)) {
    if (stop_) {
      throw DeviceStopped();
    }
    throw DeviceError("silent_device", settings_.file + " has been silent for " +
                                           std::to_string(settings_.timeout) +
                                           " s: expected measurements; reopening it");
  }
  constexpr std::size_t kAtOnce = 4096;
  std::array<char, kAtOnce> bytes;
  const ssize_t count = read(file_, bytes.data(), bytes.size());
  if (count <= 0) {
    throw DeviceError("lost_connection",
                      settings_.file + " has disappeared" +
                          (count < 0 ? " (" + std::string(std::strerror(errno)) + ")" : "") +
                          ": reopening it");
  }
  return {bytes.data(), static_cast<std::size_t>(count)};
}

}  // namespace datmo
