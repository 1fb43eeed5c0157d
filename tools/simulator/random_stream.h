// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace datmo::simulator {

/// Random numbers of one sensor. Each sensor has its own stream, seeded from the run's seed and the
/// sensor's name, so that an additional sensor does not change the measurements of the others.
///
/// The distributions are implemented here because the standard specifies only the engines: with
/// those of the library, another compiler would generate a different bag from the same seed.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, const std::string& name);

  /// Uniform in [0, 1).
  double uniform();

  /// Zero mean; `sigma` at least 0, in the unit of the result.
  double normal(double sigma);

  /// True with the given probability, 0 to 1.
  bool chance(double probability) { return uniform() < probability; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace datmo::simulator
