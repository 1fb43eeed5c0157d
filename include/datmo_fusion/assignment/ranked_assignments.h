// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "datmo_fusion/assignment/assignment.h"

namespace datmo {

/// All assignments of one problem, the best first (Murty 1968), each found only when it is
/// requested for.
///
/// Every assignment that was returned splits the ones that are left into those that differ from it
/// in the first row, those that agree there and differ in the second, and so on. With the
/// improvements of Miller, Stone and Cox (Optimizing Murty's ranked assignment method, 1997): the
/// best of each such part comes from its parent's prices by one shortest path, and is searched only
/// once its lower bound is the least of all.
class RankedAssignments {
 public:
  /// As solveAssignment(), throws the same; `max_work` is for all assignments together. It takes
  /// memory of rows + columns for each assignment that was looked at.
  RankedAssignments(CostMatrix cost, Eigen::VectorXd unassigned_cost,
                    std::int64_t max_work = kUnlimitedWork);
  ~RankedAssignments();
  RankedAssignments(RankedAssignments&&) noexcept;
  RankedAssignments& operator=(RankedAssignments&&) noexcept;

  /// The next one by rising cost (up to rounding), each once; none when there are no more, or no
  /// more within the work allowed. The first is that of solveAssignment(). Equal costs: in an order
  /// that depends on the input only.
  std::optional<Assignment> next();

  /// The work allowed was not enough for the last call of next(): there may be more assignments, or
  /// the only one is not the best.
  bool cut() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace datmo
