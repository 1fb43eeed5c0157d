// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/random_stream.h"

#include <cmath>

#include "datmo_fusion/common/angle.h"

namespace datmo::simulator {

namespace {

/// FNV-1a, because std::hash may differ between libraries.
std::uint64_t hashOf(const std::string& text) {
  constexpr std::uint64_t kOffsetBasis = 14695981039346656037ULL;
  constexpr std::uint64_t kPrime = 1099511628211ULL;
  std::uint64_t hash = kOffsetBasis;
  for (const char character : text) {
    hash ^= static_cast<unsigned char>(character);
    hash *= kPrime;
  }
  return hash;
}

std::mt19937_64 makeEngine(std::uint64_t seed, std::uint64_t stream) {
  constexpr int kHalf = 32;
  std::seed_seq sequence{
      static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> kHalf),
      static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(stream >> kHalf)};
  return std::mt19937_64(sequence);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, const std::string& name)
    : engine_(makeEngine(seed, hashOf(name))) {}

double RandomStream::uniform() {
  constexpr int kUnusedBits = 11;  // a double's mantissa holds 53 of the 64 bits
  return std::ldexp(static_cast<double>(engine_() >> kUnusedBits), -53);
}

double RandomStream::normal(double sigma) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return sigma * radius * std::cos(2.0 * kPi * uniform());
}

}  // namespace datmo::simulator
