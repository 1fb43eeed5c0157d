// SPDX-License-Identifier: BSD-3-Clause
// How often the association of already tracked targets allocates memory. Counts every operator new
// of this program; Eigen's allocations for dynamically sized matrices are not seen.

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include "association_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/tracking/multiple_hypotheses.h"
#include "datmo_fusion/tracking/nearest_neighbor.h"

namespace datmo::steady_memory_test {
namespace {

std::size_t allocations = 0;

}  // namespace
}  // namespace datmo::steady_memory_test

// Not inlined, as the compiler would report a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++datmo::steady_memory_test::allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) {
    return memory;
  }
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}

namespace datmo::steady_memory_test {
namespace {

constexpr double kPeriod = 0.1;  // s
constexpr double kSpeed = 8.0;   // m/s
constexpr int kTargets = 40;
constexpr int kWarmUp = 40;  // scans
constexpr int kScans = 20;

/// Cyclists side by side, far enough apart that no object could belong to two of them.
std::vector<Object> cyclists(int scan) {
  std::vector<Object> objects;
  for (int i = 0; i < kTargets; ++i) {
    objects.push_back(objectAt(kSpeed * kPeriod * scan, 20.0 * i, DynamicState::kMoving));
  }
  return objects;
}

/// Per target and scan, in the steady state.
struct Counts {
  double predict;
  double associate;
};

Counts countsOf(TargetSet& targets) {
  ScanSource source;
  Counts counts{};
  for (int i = 0; i < kWarmUp + kScans; ++i) {
    AssociationScan scan = source.scan(cyclists(i));
    const std::size_t before = allocations;
    targets.predict(kPeriod, scan);
    const std::size_t predicted = allocations;
    targets.associate(scan, StepBudget());
    if (i >= kWarmUp) {
      counts.predict += static_cast<double>(predicted - before) / (kTargets * kScans);
      counts.associate += static_cast<double>(allocations - predicted) / (kTargets * kScans);
    } else {
      for (const BestTarget& best : targets.best()) {
        targets.change(best.target->number(),
                       [&](Target& target) { target.confirm(target.number(), true); });
      }
    }
  }
  EXPECT_EQ(targets.best().size(), std::size_t{kTargets});
  return counts;
}

TEST(SteadyMemory, IsCounted) {
  const std::size_t before = allocations;
  const std::vector<int> some(100);
  EXPECT_EQ(allocations, before + 1) << some.size();
}

TEST(SteadyMemory, NearestNeighborPredictsWithoutAndAssociatesWithLittle) {
  NearestNeighborTargets targets{TargetOptions(), AssociationOptions()};
  const Counts counts = countsOf(targets);
  EXPECT_EQ(counts.predict, 0.0);
  EXPECT_LT(counts.associate, 3.0) << "a group of target and object, and its assignment";
}

TEST(SteadyMemory, MultipleHypothesesPredictWithoutAndAssociateWithLittle) {
  MultipleHypotheses targets{TargetOptions(), AssociationOptions(), HypothesisOptions(),
                             SplitMergeOptions()};
  const Counts counts = countsOf(targets);
  EXPECT_EQ(counts.predict, 0.0);
  EXPECT_LT(counts.associate, 25.0) << "the hypotheses of a cluster, and their ranking";
}

}  // namespace
}  // namespace datmo::steady_memory_test
