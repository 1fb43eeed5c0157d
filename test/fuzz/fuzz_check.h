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

/// One kind of input, and how many there were so far.
struct InputKind {
  const char* name;
  Decoder decoder;
  std::uint64_t inputs = 0;
  std::uint64_t accepted = 0;  ///< of these, not refused
};

/// Prints how many inputs of each kind there were: whether mutations get beyond its first checks.
template <std::size_t count>
void printCounts(const std::array<InputKind, count>& kinds) {
  for (const InputKind& kind : kinds) {
    std::fprintf(stderr, "stat::number_of_inputs: %s: %llu, accepted %llu\n", kind.name,
                 static_cast<unsigned long long>(kind.inputs),
                 static_cast<unsigned long long>(kind.accepted));
  }
}

/// Returns whether the bytes are accepted. Exceptions of these types mean that they are refused, as
/// intended; any other ends the process.
template <typename Refusal, typename... Others>
bool isAccepted(Decoder decoder, std::string_view bytes) {
  try {
    if constexpr (sizeof...(Others) > 0) {
      return isAccepted<Others...>(decoder, bytes);
    } else {
      decoder(bytes);
      return true;
    }
  } catch (const Refusal&) {
    return false;
  }
}

/// Passes an input without its first byte to the decoder of the kind that this byte selects.
/// Returns what LLVMFuzzerTestOneInput has to.
template <typename... Refusals, std::size_t count>
int decodeSelected(std::array<InputKind, count>& kinds, const std::uint8_t* data,
                   std::size_t size) {
  if (size > 0) {
    InputKind& kind = kinds[data[0] % count];
    ++kind.inputs;
    if (isAccepted<Refusals...>(kind.decoder,
                                {reinterpret_cast<const char*>(data) + 1, size - 1})) {
      ++kind.accepted;
    }
  }
  return 0;
}

}  // namespace datmo::fuzz
