// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace datmo::fuzz {

/// Ends the process unless this holds; libFuzzer then writes the input to a file.
inline void require(bool holds, const char* what) {
  if (!holds) {
    std::fprintf(stderr, "output is wrong: %s\n", what);
    std::abort();
  }
}

inline void requireFinite(double value, const char* what) { require(std::isfinite(value), what); }

/// An input without its first byte, which selects one of `count` decoders.
struct SelectedInput {
  unsigned selected = 0;
  std::string_view bytes;
};

/// `size`: 1 or more.
inline SelectedInput select(const std::uint8_t* data, std::size_t size, unsigned count) {
  return {data[0] % count, {reinterpret_cast<const char*>(data) + 1, size - 1}};
}

}  // namespace datmo::fuzz
