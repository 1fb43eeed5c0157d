// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

namespace datmo {

/// Seeded random numbers: the same seed gives the same numbers.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Returns a normal deviate with mean 0 and this standard deviation (at least 0).
  double normal(double sigma) { return sigma * standard_normal_(engine_); }

  /// Returns a uniform deviate in [low, high).
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

  /// Returns true with this probability (0 to 1).
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> standard_normal_;
};

}  // namespace datmo
