// SPDX-License-Identifier: BSD-3-Clause
// Ranked assignments: small problems as in clusters of targets, large ones, and the worst case.

#include <benchmark/benchmark.h>

#include "datmo_fusion/assignment/ranked_assignments.h"
#include "datmo_fusion/common/random.h"

namespace datmo {
namespace {

/// Costs from 0 to 1; any column is cheaper than none.
constexpr double kUnassignedCost = 1.0;

CostMatrix randomCosts(int rows, int columns) {
  Random random(1);
  CostMatrix cost(rows, columns);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      cost(row, column) = random.uniform(0.0, 1.0);
    }
  }
  return cost;
}

/// The best assignments of a dense square problem.
void rankedAssignments(benchmark::State& state) {
  const auto size = static_cast<int>(state.range(0));
  const CostMatrix cost = randomCosts(size, size);
  const Eigen::VectorXd unassigned = Eigen::VectorXd::Constant(size, kUnassignedCost);
  for (auto _ : state) {
    RankedAssignments ranked(cost, unassigned);
    for (std::int64_t i = 0; i < state.range(1); ++i) {
      benchmark::DoNotOptimize(ranked.next());
    }
  }
}
BENCHMARK(rankedAssignments)
    ->ArgNames({"size", "assignments"})
    ->ArgsProduct({{2, 6, 20, 100}, {1, 10, 100}})
    ->Unit(benchmark::kMicrosecond);

/// Every row prefers the same columns in the same order, which makes augmenting paths longest.
void oneBigCluster(benchmark::State& state) {
  const int rows = 300;
  const int columns = 1000;
  CostMatrix cost(rows, columns);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      cost(row, column) = (row + 1.0) * (column + 1.0);
    }
  }
  const Eigen::VectorXd unassigned = Eigen::VectorXd::Constant(rows, rows * columns);
  Assignment best;
  for (auto _ : state) {
    best = solveAssignment(cost, unassigned, state.range(0));
  }
  state.counters["cut"] = best.cut ? 1.0 : 0.0;
}
BENCHMARK(oneBigCluster)
    ->ArgName("max_work")
    ->Arg(kUnlimitedWork)
    ->Arg(5000000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace datmo
