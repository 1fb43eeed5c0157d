// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
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

/// Decodes bytes and checks what comes out.
using Decoder = void (*)(std::string_view bytes);

/// Exceptions of these types mean that the bytes are refused, as intended; any other ends the
/// process.
template <typename Refusal, typename... Others>
void decodeOrRefuse(Decoder decoder, std::string_view bytes) {
  try {
    if constexpr (sizeof...(Others) > 0) {
      decodeOrRefuse<Others...>(decoder, bytes);
    } else {
      decoder(bytes);
    }
  } catch (const Refusal&) {
  }
}

/// Passes an input without its first byte to the decoder that this byte selects. Returns what
/// LLVMFuzzerTestOneInput has to.
template <typename... Refusals, std::size_t count>
int decodeSelected(const std::array<Decoder, count>& decoders, const std::uint8_t* data,
                   std::size_t size) {
  if (size > 0) {
    decodeOrRefuse<Refusals...>(decoders[data[0] % count],
                                {reinterpret_cast<const char*>(data) + 1, size - 1});
  }
  return 0;
}

}  // namespace datmo::fuzz
