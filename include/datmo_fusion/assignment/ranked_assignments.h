// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "datmo_fusion/assignment/assignment.h"

namespace datmo {

/// All assignments of one problem, best first (Murty 1968), each computed only on request.
///
/// Every assignment that was returned splits the remaining ones into those that differ from it in
/// the first row, those that agree there and differ in the second, and so on. With the improvements
/// of Miller, Stone and Cox (Optimizing Murty's ranked assignment method, 1997): the best of each
/// part follows from its parent's prices by a single shortest path, and is only searched for once
/// its lower bound is the smallest of all.
class RankedAssignments {
 public:
  /// As solveAssignment(), with the same exceptions; `max_work` is for all assignments together.
  /// Memory: rows + columns for each assignment that was evaluated.
  RankedAssignments(CostMatrix cost, Eigen::VectorXd unassigned_cost,
                    std::int64_t max_work = kUnlimitedWork);
  ~RankedAssignments();
  RankedAssignments(RankedAssignments&&) noexcept;
  RankedAssignments& operator=(RankedAssignments&&) noexcept;

  /// Returns the next assignment by ascending cost (up to rounding), each once; none if there are
  /// no more, or none within the work limit. The first is that of solveAssignment(). The order of
  /// equal costs depends only on the input.
  std::optional<Assignment> next();

  /// Returns whether the work limit was reached in the last call of next(): there may be more
  /// assignments, or the only one is not optimal.
  bool cut() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace datmo
