// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace datmo {

/// Names one random number: the same key gives the same number in every assessment, so that
/// probabilities change with what is measured, not with the draw (common random numbers;
/// Glasserman, Monte Carlo Methods in Financial Engineering, 2004, 7.1).
struct DrawKey {
  std::uint32_t body = 0;    ///< id of a track, 0: the host
  std::uint32_t future = 0;  ///< index of the joint future
  std::uint32_t step = 0;    ///< of time
  std::uint32_t kind = 0;    ///< what it is for
};

/// What one key gives at once.
struct StepDraws {
  double uniform = 0.0;  ///< in [0, 1)
  double first = 0.0;    ///< standard normal
  double second = 0.0;   ///< standard normal
};

/// Seeded random numbers that are looked up, not drawn in turn. Numbers of different keys are
/// independent for all that futures need.
class RandomDraws {
 public:
  explicit RandomDraws(std::uint64_t seed);

  /// Standard normal.
  double normal(const DrawKey& key) const;
  /// Uniform in [0, 1).
  double uniform(const DrawKey& key) const;
  /// Three numbers at the cost of one; of the same key they have nothing to do with the others.
  StepDraws step(const DrawKey& key) const;

 private:
  std::uint64_t seed_;
  std::vector<double> normals_;
};

}  // namespace datmo
