// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "datmo_fusion/device/can_frame.h"

namespace datmo {

/// Where a number stands in a frame, and what it means, in the terms of DBC files (Vector
/// Informatik, DBC File Format Documentation, 1.0.5, 2010).
struct CanSignal {
  CanId id;
  /// Of the least significant bit (Intel), or of the most significant one (Motorola): eight times
  /// the byte plus the bit in it, of which 0 is the least significant.
  unsigned start = 0;
  unsigned length = 8;         ///< bits, 1 to 64
  bool is_big_endian = false;  ///< Motorola: a value goes on in the upper bits of the next byte
  bool is_signed = false;      ///< two's complement
  double factor = 1.0;         ///< value = factor · raw + offset
  double offset = 0.0;
  double min = 0.0;  ///< of the value; where both are the same there are no limits
  double max = 0.0;
  std::string unit;

  /// Bytes that a frame has at least for it.
  std::size_t bytes() const;

  /// The bits, not yet signed or scaled; none from a frame that is too short.
  std::optional<std::uint64_t> raw(const CanFrame& frame) const;

  /// The value; none from a frame that is too short.
  std::optional<double> value(const CanFrame& frame) const;

  bool isInLimits(double value) const { return min == max || (value >= min && value <= max); }
};

/// A signal as DBC files write it behind its name: `8|16@1+ (0.01,0) [0|250] "km/h"`; 1: Intel, 0:
/// Motorola; + unsigned, - signed. The limits and the unit may be missing, and so the quotes and
/// what follows. Throws OptionError: `name` says what it is for.
CanSignal canSignal(const std::string& name, const CanId& id, const std::string& text);

/// An id as DBC files write it: bit 31 says that it is extended, which one of more than 11 bits is
/// without it, too. Throws OptionError.
CanId canId(const std::string& name, std::uint64_t number);

}  // namespace datmo
