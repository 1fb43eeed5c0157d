// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/assignment/assignment.h"

#include <array>
#include <cstddef>
#include <memory_resource>

#include "augmenting_path.h"
#include "priced_assignment.h"

namespace datmo {

namespace {

/// Scratch memory on the stack, bytes: enough for most problems, which are tiny.
constexpr std::size_t kScratch = 2048;

}  // namespace

Assignment solveAssignment(const CostMatrix& cost, const Eigen::VectorXd& unassigned_cost,
                           std::int64_t max_work) {
  checkSizes(cost, unassigned_cost);
  alignas(std::max_align_t) std::array<std::byte, kScratch> scratch;
  std::pmr::monotonic_buffer_resource memory(scratch.data(), scratch.size());
  const AssignmentCosts costs(cost, unassigned_cost, &memory);
  AugmentingPath path(costs, &memory);
  PricedAssignment best(costs.rows(), costs.columns(), &memory);
  const bool all = assignAll(costs, max_work, path, best);
  return {{best.column_of_row.begin(), best.column_of_row.end()},
          totalCost(best.column_of_row, costs),
          !all,
          path.work()};
}

}  // namespace datmo
