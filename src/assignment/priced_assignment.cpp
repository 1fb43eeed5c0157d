// SPDX-License-Identifier: BSD-3-Clause
#include "priced_assignment.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace datmo {

namespace {

/// Maximum number of columns per row in most problems; memory for more is allocated when needed.
constexpr int kUsualColumns = 4;

/// Returns whether all of four costs are forbidden.
bool isForbidden(const double* costs) {
  return std::min(std::min(costs[0], costs[1]), std::min(costs[2], costs[3])) == kForbidden;
}

double minOut(int row, const RowCost& row_cost, const AssignmentCosts& costs,
              const PricedAssignment& assignment) {
  double min = row_cost.unassigned;
  for (const int column : costs.possible(row)) {
    if (assignment.row_of_column[column] != kFixed) {
      min = std::min(min, row_cost.columns[column] - assignment.column_price[column]);
    }
  }
  return min - assignment.row_price[row];
}

/// From the void, if the column may stay free, or from another open row.
double minIntoColumn(int column, int row, const AssignmentCosts& costs, const RowsOfColumns& rows,
                     const PricedAssignment& assignment) {
  double min = 0.0;
  for (const int other : rows.possible(column)) {
    if (other != row && assignment.is_open[other] != 0) {
      min = std::min(min, costs.pairs(other, column) - assignment.row_price[other]);
    }
  }
  return min - assignment.column_price[column];
}

}  // namespace

AssignmentCosts::AssignmentCosts(const CostMatrix& all_pairs,
                                 const Eigen::VectorXd& unassigned_cost,
                                 std::pmr::memory_resource* memory)
    : pairs(all_pairs), unassigned(unassigned_cost), columns_(memory), first_(memory) {
  first_.reserve(rows() + 1);
  columns_.reserve(std::min<std::ptrdiff_t>(pairs.size(), std::ptrdiff_t{kUsualColumns} * rows()));
  for (int row = 0; row < rows(); ++row) {
    first_.push_back(static_cast<int>(columns_.size()));
    const double* cost = pairs.row(row).data();
    for (int column = 0; column < columns(); ++column) {
      if (column + 3 < columns() && isForbidden(cost + column)) {
        column += 3;
      } else if (cost[column] < kForbidden) {
        columns_.push_back(column);
      }
    }
  }
  first_.push_back(static_cast<int>(columns_.size()));
}

RowsOfColumns::RowsOfColumns(const AssignmentCosts& costs, std::pmr::memory_resource* memory)
    : rows_(memory), first_(costs.columns() + 2, 0, memory) {
  for (int row = 0; row < costs.rows(); ++row) {
    for (const int column : costs.possible(row)) {
      ++first_[column + 2];
    }
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  rows_.resize(first_.back());
  for (int row = 0; row < costs.rows(); ++row) {
    for (const int column : costs.possible(row)) {
      rows_[first_[column + 1]++] = row;  // the end of the previous column
    }
  }
}

PricedAssignment::PricedAssignment(int rows, int columns, std::pmr::memory_resource* memory)
    : row_price(rows, 0.0, memory),
      column_price(columns, 0.0, memory),
      column_of_row(rows, kUnassigned, memory),
      row_of_column(columns, kUnassigned, memory),
      open_rows(memory),
      is_open(rows, 0, memory) {
  open_rows.reserve(rows);
}

void PricedAssignment::open(int row) {
  open_rows.push_back(row);
  is_open[row] = 1;
}

void PricedAssignment::fix(int row) {
  open_rows.erase(std::find(open_rows.begin(), open_rows.end(), row));
  is_open[row] = 0;
  if (column_of_row[row] != kUnassigned) {
    row_of_column[column_of_row[row]] = kFixed;
  }
}

void PricedAssignment::openOnly(const int* begin, const int* end) {
  open_rows.clear();
  std::fill(is_open.begin(), is_open.end(), char{0});
  std::for_each(begin, end, [this](int row) { open(row); });
}

double totalCost(const std::pmr::vector<int>& column_of_row, const AssignmentCosts& costs) {
  double sum = 0.0;
  for (int row = 0; row < costs.rows(); ++row) {
    const int column = column_of_row[row];
    sum += column == kUnassigned ? costs.unassigned[row] : costs.pairs(row, column);
  }
  return sum;
}

double minIntoVoid(const AssignmentCosts& costs, const PricedAssignment& assignment) {
  double min = kForbidden;
  for (const int row : assignment.open_rows) {
    if (assignment.column_of_row[row] != kUnassigned) {
      min = std::min(min, costs.unassigned[row] - assignment.row_price[row]);
    }
  }
  for (std::size_t column = 0; column < assignment.column_price.size(); ++column) {
    if (assignment.row_of_column[column] == kUnassigned) {
      min = std::min(min, assignment.column_price[column]);
    }
  }
  return min;
}

double minIncrease(int row, const RowCost& row_cost, const AssignmentCosts& costs,
                   const RowsOfColumns& rows, const PricedAssignment& assignment,
                   double into_void) {
  const double out = minOut(row, row_cost, costs, assignment);
  if (out == kForbidden) {
    return kForbidden;
  }
  const int column = assignment.column_of_row[row];
  const double in =
      column == kUnassigned ? into_void : minIntoColumn(column, row, costs, rows, assignment);
  return std::max(out + in, 0.0);
}

void checkSizes(const CostMatrix& cost, const Eigen::VectorXd& unassigned_cost) {
  if (cost.rows() != unassigned_cost.size()) {
    throw std::invalid_argument(
        "costs of staying unassigned: " + std::to_string(unassigned_cost.size()) +
        ", expected one for each row: " + std::to_string(cost.rows()));
  }
}

}  // namespace datmo
