// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/random_draws.h"

#include <cmath>

#include <Eigen/Core>

#include "datmo_fusion/common/random.h"

namespace datmo {

namespace {

/// Bits of an index into the table: 16,384 numbers resolve the tails to 3.8 standard deviations.
constexpr unsigned kTableBits = 14;
constexpr std::size_t kTableSize = std::size_t{1} << kTableBits;
constexpr unsigned kWordBits = 64;
/// Bits of a double's fraction.
constexpr unsigned kFractionBits = 53;

/// The finalizer of SplitMix64 (Steele, Lea, Flood, Fast splittable pseudorandom number generators,
/// OOPSLA 2014).
std::uint64_t mixed(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15ULL;
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31U);
}

std::uint64_t wordOf(std::uint64_t seed, const DrawKey& key) {
  constexpr unsigned kHalf = 32;
  const std::uint64_t body_and_future = (std::uint64_t{key.body} << kHalf) | key.future;
  const std::uint64_t step_and_kind = (std::uint64_t{key.step} << kHalf) | key.kind;
  return mixed(mixed(seed ^ body_and_future) ^ step_and_kind);
}

}  // namespace

RandomDraws::RandomDraws(std::uint64_t seed) : seed_(seed), normals_(kTableSize) {
  Random random(seed);
  for (double& normal : normals_) {
    normal = random.normal(1.0);
  }
  // Mean 0 and variance 1 exactly, unlike those of a sample.
  Eigen::Map<Eigen::ArrayXd> table(normals_.data(), static_cast<Eigen::Index>(kTableSize));
  table -= table.mean();
  table /= std::sqrt(table.square().mean());
}

double RandomDraws::normal(const DrawKey& key) const {
  return normals_[wordOf(seed_, key) >> (kWordBits - kTableBits)];
}

double RandomDraws::uniform(const DrawKey& key) const {
  constexpr double kUnit = 1.0 / static_cast<double>(std::uint64_t{1} << kFractionBits);
  return static_cast<double>(wordOf(seed_, key) >> (kWordBits - kFractionBits)) * kUnit;
}

StepDraws RandomDraws::step(const DrawKey& key) const {
  constexpr unsigned kUniformBits = kWordBits - 2 * kTableBits;
  constexpr double kUnit = 1.0 / static_cast<double>(std::uint64_t{1} << kUniformBits);
  const std::uint64_t word = mixed(wordOf(seed_, key));
  constexpr std::uint64_t kMask = kTableSize - 1;
  return {static_cast<double>(word >> (2 * kTableBits)) * kUnit, normals_[word & kMask],
          normals_[(word >> kTableBits) & kMask]};
}

}  // namespace datmo
