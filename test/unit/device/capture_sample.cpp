// SPDX-License-Identifier: BSD-3-Clause
#include "device/capture_sample.h"

#include <cmath>
#include <fstream>

namespace datmo::samples {

namespace {

/// In network byte order.
std::string word(unsigned value) {
  return {static_cast<char>(value >> 8U), static_cast<char>(value & 0xFFU)};
}

/// In this computer's byte order, which the file's magic number indicates.
std::string number(std::uint32_t value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

}  // namespace

std::string ethernetFrame(const CapturedDatagram& datagram) {
  const auto length = static_cast<unsigned>(datagram.data.size());
  const std::string addresses(12, '\x01');
  const std::string ip = std::string("\x45\x00", 2) + word(28 + length) + word(0) + word(0x4000) +
                         "\x40\x11" + word(0) + std::string(8, '\x0A');
  const std::string udp =
      word(2368) + word(static_cast<unsigned>(datagram.port)) + word(8 + length) + word(0);
  return addresses + word(0x0800) + ip + udp + datagram.data;
}

void writeCapture(const std::string& file, const std::vector<CapturedDatagram>& datagrams,
                  std::uint32_t link) {
  constexpr std::uint32_t kLongest = 65535;
  std::ofstream out(file, std::ios::binary);
  out << number(0xA1B2C3D4U) << number(0x00040002U) << number(0) << number(0) << number(kLongest)
      << number(link);
  for (const CapturedDatagram& datagram : datagrams) {
    const std::string frame = ethernetFrame(datagram);
    const double second = std::floor(datagram.time);
    const auto size = static_cast<std::uint32_t>(frame.size());
    out << number(static_cast<std::uint32_t>(second))
        << number(static_cast<std::uint32_t>((datagram.time - second) * 1e6)) << number(size)
        << number(size) << frame;
  }
}

}  // namespace datmo::samples
