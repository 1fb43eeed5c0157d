// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace datmo {

/// Cost of assigning a column to a row; infinity: forbidden. NaN and minus infinity are not
/// allowed.
using CostMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

inline constexpr double kForbidden = std::numeric_limits<double>::infinity();
inline constexpr int kUnassigned = -1;

struct Assignment {
  std::vector<int> column_of_row;  ///< kUnassigned: the row has none
  double cost = 0.0;               ///< of all rows
  bool cut = false;                ///< the work limit was reached: valid, but not optimal
  std::int64_t work = 0;           ///< pairs, rows and columns that were visited
};

/// No limit of work.
inline constexpr std::int64_t kUnlimitedWork = std::numeric_limits<std::int64_t>::max();

/// Returns the assignment of minimum total cost: each column has at most one row, and each row has
/// one column or pays its cost of staying unassigned (finite, one per row). Costs may be negative.
///
/// Shortest augmenting paths (Jonker and Volgenant 1987; Crouse, On implementing 2D rectangular
/// assignment algorithms, 2016), O(rows^2 columns). Each row's private column for staying
/// unassigned is never stored. On a tie, the earlier column is taken, and any column rather than
/// none.
///
/// `max_work`: after this many visited pairs, rows and columns (1 ns to 2 ns each), the remaining
/// rows, in their order, get the cheapest free column. It is counted, not timed, so the same input
/// gives the same output. Throws std::invalid_argument on sizes that do not match.
Assignment solveAssignment(const CostMatrix& cost, const Eigen::VectorXd& unassigned_cost,
                           std::int64_t max_work = kUnlimitedWork);

}  // namespace datmo
