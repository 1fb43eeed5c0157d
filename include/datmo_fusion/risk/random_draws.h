// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace datmo {

/// Key of one random number: the same key gives the same number in every assessment, so that
/// probabilities change with the measurements, not with the samples (common random numbers;
/// Glasserman, Monte Carlo Methods in Financial Engineering, 2004, 7.1).
struct DrawKey {
  std::uint32_t body = 0;    ///< id of a track, 0: the host
  std::uint32_t future = 0;  ///< index of the joint future
  std::uint32_t step = 0;    ///< time step
  std::uint32_t kind = 0;    ///< its purpose
};

/// Three numbers of one key.
struct StepDraws {
  double uniform = 0.0;  ///< in [0, 1)
  double first = 0.0;    ///< standard normal
  double second = 0.0;   ///< standard normal
};

/// Seeded random numbers that are looked up, not drawn in sequence. Numbers of different keys are
/// sufficiently independent for the futures.
class RandomDraws {
 public:
  explicit RandomDraws(std::uint64_t seed);

  /// Returns a standard normal number.
  double normal(const DrawKey& key) const;
  /// Returns a uniform number in [0, 1).
  double uniform(const DrawKey& key) const;
  /// Returns three numbers at the cost of one; they are unrelated to the other numbers of the same
  /// key.
  StepDraws step(const DrawKey& key) const;

 private:
  std::uint64_t seed_;
  std::vector<double> normals_;
};

}  // namespace datmo
