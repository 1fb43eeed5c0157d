// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "datmo_fusion/device/can_motion.h"

namespace datmo::samples {

inline CanFrame canFrame(std::uint32_t number, const std::vector<std::uint8_t>& data) {
  CanFrame frame;
  frame.id = canId("sample", number);
  frame.size = static_cast<std::uint8_t>(data.size());
  std::copy(data.begin(), data.end(), frame.data.begin());
  return frame;
}

constexpr std::uint32_t kSpeedId = 0x1A0;
constexpr std::uint32_t kYawId = 0x1B0;

/// A made-up vehicle: no real make has these messages.
inline CanOptions canSample() {
  CanOptions options;
  options.speed = "0x1A0 8|16@1+ (0.01,0) [0|250] \"km/h\"";
  options.counter = "0x1A0 0|4@1+ (1,0)";
  options.yaw_rate = "0x1B0 7|16@0- (0.01,0) [-150|150] \"deg/s\"";
  return options;
}

/// `speed`: m/s.
inline CanFrame speedFrame(double speed, unsigned counter) {
  const auto raw = static_cast<unsigned>(std::lround(360.0 * speed));
  return canFrame(kSpeedId,
                  {static_cast<std::uint8_t>(counter & 15U), static_cast<std::uint8_t>(raw & 255U),
                   static_cast<std::uint8_t>(raw >> 8U)});
}

/// `rate`: deg/s.
inline CanFrame yawFrame(double rate) {
  const auto raw = static_cast<unsigned>(std::lround(100.0 * rate)) & 0xFFFFU;
  return canFrame(kYawId,
                  {static_cast<std::uint8_t>(raw >> 8U), static_cast<std::uint8_t>(raw & 255U)});
}

/// A line of candump -L. `time`: s.
inline std::string canLogText(double time, const CanFrame& frame) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.6f) can0 %03X#", time, frame.id.number);
  std::string line = text;
  for (std::size_t i = 0; i < frame.size; ++i) {
    std::snprintf(text, sizeof text, "%02X", frame.data[i]);
    line += text;
  }
  return line + "\n";
}

}  // namespace datmo::samples
