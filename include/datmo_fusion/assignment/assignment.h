// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace datmo {

/// Cost of giving a column to a row; infinity: forbidden. NaN and minus infinity are not allowed.
using CostMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

inline constexpr double kForbidden = std::numeric_limits<double>::infinity();
inline constexpr int kUnassigned = -1;

struct Assignment {
  std::vector<int> column_of_row;  ///< kUnassigned: the row has none
  double cost = 0.0;               ///< of all rows
  bool cut = false;                ///< more work than allowed: valid, but not the best
  std::int64_t work = 0;           ///< pairs, rows and columns that were looked at
};

/// As a limit of work: none.
inline constexpr std::int64_t kUnlimitedWork = std::numeric_limits<std::int64_t>::max();

/// The assignment of least total cost, where a column goes to at most one row, and each row has one
/// column or pays its cost of having none (finite, one for each row). Costs may be negative.
///
/// Shortest augmenting paths (Jonker and Volgenant 1987; Crouse, On implementing 2D rectangular
/// assignment algorithms, 2016), O(rows^2 columns). The column of staying unassigned, which every
/// row has to itself, is never stored. Equal costs: the earlier column, and a column rather than
/// none.
///
/// `max_work`: once more pairs, rows and columns than this were looked at (1 ns to 2 ns each), the
/// rows that are left, in their order, get the cheapest column that is free. Counted, not timed:
/// the same input gives the same output. Throws std::invalid_argument on sizes that do not match.
Assignment solveAssignment(const CostMatrix& cost, const Eigen::VectorXd& unassigned_cost,
                           std::int64_t max_work = kUnlimitedWork);

}  // namespace datmo
