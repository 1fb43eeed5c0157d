// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory_resource>
#include <vector>

#include "datmo_fusion/assignment/assignment.h"

namespace datmo {

/// What one row may have: costs of all columns, and of none.
struct RowCost {
  const double* columns = nullptr;
  double unassigned = 0.0;
};

/// The columns that a row may have, rising; or the rows that may have a column.
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

/// The costs of a problem, which are kept elsewhere, and which pairs are possible: in most problems
/// few of all.
class AssignmentCosts {
 public:
  AssignmentCosts(const CostMatrix& all_pairs, const Eigen::VectorXd& unassigned_cost,
                  std::pmr::memory_resource* memory);

  const CostMatrix& pairs;
  const Eigen::VectorXd& unassigned;

  int rows() const { return static_cast<int>(pairs.rows()); }
  int columns() const { return static_cast<int>(pairs.cols()); }
  RowCost row(int row) const { return {pairs.row(row).data(), unassigned[row]}; }

  /// Columns that a row may have.
  Possible possible(int row) const {
    return {columns_.data() + first_[row], columns_.data() + first_[row + 1]};
  }

 private:
  std::pmr::vector<int> columns_;  ///< row after row
  std::pmr::vector<int> first_;    ///< of each row, and the end
};

/// The rows that may have each column: of those that are possible at all, in most problems few.
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

/// In place of the row that has a column.
inline constexpr int kFixed = -2;

/// An assignment and the prices (dual variables) that prove it to be the best.
///
/// The problem as a flow: each row sends one unit to a column, for the pair's cost, or straight to
/// the void, for its cost of having no column; a column that takes a unit hands it on to the void,
/// for nothing. With the price of the void at 0, of a row p and of a column q:
///   cost - p - q >= 0 for every pair, = 0 where assigned;
///   p <= cost of having no column where the row has one, >= where it has none;
///   q <= 0 where the column is taken, >= 0 where it is free.
struct PricedAssignment {
  /// Nothing assigned, all prices 0, no row open.
  PricedAssignment(int rows, int columns, std::pmr::memory_resource* memory);

  /// A row may get another column.
  void open(int row);

  /// A row keeps what it has.
  void fix(int row);

  /// These rows are open, and no others.
  void openOnly(const int* begin, const int* end);

  std::pmr::vector<double> row_price;
  std::pmr::vector<double> column_price;
  std::pmr::vector<int> column_of_row;
  std::pmr::vector<int> row_of_column;  ///< kUnassigned: free; kFixed: of a row that keeps it
  std::pmr::vector<int> open_rows;      ///< that may get another column
  std::pmr::vector<char> is_open;       ///< the same, by row
};

/// Sum over all rows.
double totalCost(const std::pmr::vector<int>& column_of_row, const AssignmentCosts& costs);

/// Bound from below of how much dearer the assignment becomes once an open row may only have what
/// `row_cost` allows, which is not what it has: the first step of the path to its new column, and
/// the last one to its old column (AugmentingPath). kForbidden: there is no other column.
/// `into_void`: see minIntoVoid(); only of use if the row has no column.
double minIncrease(int row, const RowCost& row_cost, const AssignmentCosts& costs,
                   const RowsOfColumns& rows, const PricedAssignment& assignment, double into_void);

/// The last step of such a path to the void: from an open row that gives its column up, or from a
/// free column. The same for all rows without column.
double minIntoVoid(const AssignmentCosts& costs, const PricedAssignment& assignment);

/// Throws std::invalid_argument where they do not belong together.
void checkSizes(const CostMatrix& cost, const Eigen::VectorXd& unassigned_cost);

}  // namespace datmo
