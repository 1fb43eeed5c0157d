// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "datmo_fusion/device/can_frame.h"

namespace datmo {

/// Position and meaning of a number in a frame, in the terms of DBC files (Vector Informatik, DBC
/// File Format Documentation, 1.0.5, 2010).
struct CanSignal {
  CanId id;
  /// Position of the least significant bit (Intel), or of the most significant one (Motorola):
  /// eight times the byte plus the bit in it, where 0 is the least significant bit.
  unsigned start = 0;
  unsigned length = 8;         ///< bits, 1 to 64
  bool is_big_endian = false;  ///< Motorola: a value continues in the upper bits of the next byte
  bool is_signed = false;      ///< two's complement
  double factor = 1.0;         ///< value = factor · raw + offset
  double offset = 0.0;
  double min = 0.0;  ///< of the value; no limits if both are equal
  double max = 0.0;
  std::string unit;

  /// Returns the least number of bytes of a frame with this signal.
  std::size_t bytes() const;

  /// Returns the bits, not yet signed or scaled; none if the frame is too short.
  std::optional<std::uint64_t> raw(const CanFrame& frame) const;

  /// Returns the value; none if the frame is too short.
  std::optional<double> value(const CanFrame& frame) const;

  bool isInLimits(double value) const { return min == max || (value >= min && value <= max); }
};

/// Parses a signal as DBC files write it after its name: `8|16@1+ (0.01,0) [0|250] "km/h"`; 1:
/// Intel, 0: Motorola; + unsigned, - signed. The limits and the unit may be missing, as may the
/// quotes and what follows. Throws OptionError; `name`: of the option, for the error message.
CanSignal canSignal(const std::string& name, const CanId& id, const std::string& text);

/// Decodes an id as DBC files write it: bit 31 marks an extended id; one of more than 11 bits is
/// extended even without it. Throws OptionError.
CanId canId(const std::string& name, std::uint64_t number);

}  // namespace datmo
