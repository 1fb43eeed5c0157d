// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "datmo_fusion/device/device_error.h"

namespace datmo {

/// Identifier of a message on a CAN bus: 11 bits, or 29 if extended.
struct CanId {
  std::uint32_t number = 0;
  bool is_extended = false;

  bool operator==(const CanId& other) const {
    return number == other.number && is_extended == other.is_extended;
  }
};

/// Returns a readable form: "0x1A0", "0x18FEF100 (29 bits)".
std::string toText(const CanId& id);

/// A frame of CAN (8 bytes) or CAN FD (64 bytes).
struct CanFrame {
  static constexpr std::size_t kLongest = 64;

  CanId id;
  std::uint8_t size = 0;  ///< of its data, bytes
  std::array<std::uint8_t, kLongest> data{};
  double age = 0.0;                    ///< s, since it was received
  std::uint64_t lost = 0;              ///< frames that the computer lost since the last one
  std::optional<std::uint32_t> error;  ///< CAN_ERR_… bits of an error frame; none: a data frame
};

/// Invalid data were received instead of a frame; the next frame may be valid.
class CanFrameError : public DeviceError {
 public:
  explicit CanFrameError(const std::string& message) : DeviceError("bad_frame", message) {}
};

/// Source of the frames of a bus.
class CanSource {
 public:
  virtual ~CanSource() = default;

  /// Waits for the next data or error frame. Throws CanFrameError, DeviceError, DeviceStopped.
  virtual CanFrame next() = 0;
};

}  // namespace datmo
