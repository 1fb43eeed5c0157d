// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory_resource>
#include <vector>

#include "datmo_fusion/assignment/assignment.h"

namespace datmo {

/// The options of one row: the costs of all columns, and of none.
struct RowCost {
  const double* columns = nullptr;
  double unassigned = 0.0;
};

/// The columns that a row may have, ascending; or the rows that may have a column.
class Possible {
 public:
  Possible(const int* begin, const int* end) : begin_(begin), end_(end) {}
  const int* begin() const { return begin_; }
  const int* end() const { return end_; }
  std::ptrdiff_t size() const { return end_ - begin_; }

 private:
  const int* begin_;
  const int* end_;
};

/// The costs of a problem, which are stored elsewhere, and the possible pairs, in most problems
/// few.
class AssignmentCosts {
 public:
  AssignmentCosts(const CostMatrix& all_pairs, const Eigen::VectorXd& unassigned_cost,
                  std::pmr::memory_resource* memory);

  const CostMatrix& pairs;
  const Eigen::VectorXd& unassigned;

  int rows() const { return static_cast<int>(pairs.rows()); }
  int columns() const { return static_cast<int>(pairs.cols()); }
  RowCost row(int row) const { return {pairs.row(row).data(), unassigned[row]}; }

  /// Returns the columns that a row may have.
  Possible possible(int row) const {
    return {columns_.data() + first_[row], columns_.data() + first_[row + 1]};
  }

 private:
  std::pmr::vector<int> columns_;  ///< row after row
  std::pmr::vector<int> first_;    ///< of each row, and the end
};

/// The rows that may have each column; in most problems few pairs are possible.
class RowsOfColumns {
 public:
  RowsOfColumns(const AssignmentCosts& costs, std::pmr::memory_resource* memory);

  Possible possible(int column) const {
    return {rows_.data() + first_[column], rows_.data() + first_[column + 1]};
  }

 private:
  std::pmr::vector<int> rows_;   ///< column after column
  std::pmr::vector<int> first_;  ///< of each column, and the end
};

/// Stands for the row that has a column.
inline constexpr int kFixed = -2;

/// An assignment and the prices (dual variables) that prove its optimality.
///
/// The problem as a flow: each row sends one unit to a column, at the pair's cost, or directly to
/// the void, at its cost of having no column; a column that receives a unit passes it on to the
/// void, for free. With the price of the void at 0, that of a row p and that of a column q:
///   cost - p - q >= 0 for every pair, = 0 where assigned;
///   p <= cost of having no column where the row has one, >= where it has none;
///   q <= 0 where the column is taken, >= 0 where it is free.
struct PricedAssignment {
  /// Nothing assigned, all prices 0, no row open.
  PricedAssignment(int rows, int columns, std::pmr::memory_resource* memory);

  /// Allows a row to get another column.
  void open(int row);

  /// Fixes what a row has.
  void fix(int row);

  /// Opens these rows, and no others.
  void openOnly(const int* begin, const int* end);

  std::pmr::vector<double> row_price;
  std::pmr::vector<double> column_price;
  std::pmr::vector<int> column_of_row;
  std::pmr::vector<int> row_of_column;  ///< kUnassigned: free; kFixed: its row is fixed
  std::pmr::vector<int> open_rows;      ///< that may get another column
  std::pmr::vector<char> is_open;       ///< the same, by row
};

/// Returns the sum over all rows.
double totalCost(const std::pmr::vector<int>& column_of_row, const AssignmentCosts& costs);

/// Returns a lower bound of the cost increase if an open row may only have what `row_cost` allows,
/// which excludes its current column: the first step of the path to its new column, and the last
/// one to its old column (AugmentingPath). kForbidden: there is no other column. `into_void`: see
/// minIntoVoid(); only used if the row has no column.
double minIncrease(int row, const RowCost& row_cost, const AssignmentCosts& costs,
                   const RowsOfColumns& rows, const PricedAssignment& assignment, double into_void);

/// Returns the last step of such a path to the void: from an open row that gives up its column, or
/// from a free column. The same for all rows without a column.
double minIntoVoid(const AssignmentCosts& costs, const PricedAssignment& assignment);

/// Throws std::invalid_argument if the sizes do not match.
void checkSizes(const CostMatrix& cost, const Eigen::VectorXd& unassigned_cost);

}  // namespace datmo
