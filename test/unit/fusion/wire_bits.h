// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo::samples {

/// Bits of a message, field by field: the value above the field's minimum, and the number of bits
/// of its range, both given by the test.
class WireBits {
 public:
  WireBits& add(std::uint64_t above_minimum, int width) {
    for (int i = width - 1; i >= 0; --i) {
      bits_.push_back(((above_minimum >> static_cast<unsigned int>(i)) & 1U) != 0U ? '1' : '0');
    }
    return *this;
  }

  WireBits& add(const WireBits& other) {
    bits_ += other.bits_;
    return *this;
  }

  /// An open type: the number of octets, below 128, and the bits padded with zeros to whole octets.
  WireBits& addOpen(const WireBits& content) {
    const std::string octets = content.bytes();
    add(octets.size(), 8);
    for (const char octet : octets) {
      add(static_cast<unsigned char>(octet), 8);
    }
    return *this;
  }

  std::size_t size() const { return bits_.size(); }

  std::string bytes() const {
    std::string octets;
    for (std::size_t i = 0; i < bits_.size(); ++i) {
      if (i % 8 == 0) {
        octets.push_back('\0');
      }
      if (bits_[i] == '1') {
        octets.back() = static_cast<char>(static_cast<unsigned char>(octets.back()) |
                                          static_cast<unsigned char>(128U >> (i % 8)));
      }
    }
    return octets;
  }

 private:
  std::string bits_;
};

/// Returns the reason of the WireError that it throws; empty: none.
inline std::string refusalOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const WireError& error) {
    return error.reason();
  }
  return "";
}

}  // namespace datmo::samples
