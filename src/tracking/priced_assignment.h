#pragma once

#include <memory_resource>
#include <vector>

#include "datmo_fusion/tracking/assignment.h"

namespace datmo {

/// An assignment and the prices (dual variables) that prove it to be the best.
///
/// The problem as a flow: each row sends one unit to a column, for the pair's cost, or straight to
/// the void, for its cost of having no column; a column that takes a unit hands it on to the void,
/// for nothing. With the price of the void at 0, of a row p and of a column q:
///   cost - p - q >= 0 for every pair, = 0 where assigned;
///   p <= cost of having no column where the row has one, >= where it has none;
///   q <= 0 where the column is taken, >= 0 where it is free.
struct PricedAssignment {
  /// Nothing assigned, all prices 0.
  PricedAssignment(int rows, int columns, std::pmr::memory_resource* memory)
      : row_price(rows, 0.0, memory),
        column_price(columns, 0.0, memory),
        column_of_row(rows, kUnassigned, memory),
        row_of_column(columns, kUnassigned, memory) {}

  std::pmr::vector<double> row_price;
  std::pmr::vector<double> column_price;
  std::pmr::vector<int> column_of_row;
  std::pmr::vector<int> row_of_column;
};

/// Of all rows: the sum of the pairs' costs, and of those of having no column.
double totalCost(const std::pmr::vector<int>& column_of_row, const CostMatrix& cost,
                 const Eigen::VectorXd& unassigned_cost);

class AugmentingPath;

/// The best assignment, from one that has nothing yet; one row after the other gets its place.
/// False: it took more than `most_work` (AugmentingPath::work()), and the rows that were left got
/// the cheapest column that was free: `assignment` is valid but not the best, and its prices are
/// not.
bool assignAll(const CostMatrix& cost, const Eigen::VectorXd& unassigned_cost,
               std::int64_t most_work, AugmentingPath& path, PricedAssignment& assignment);

/// Throws std::invalid_argument where they do not belong together.
void checkSizes(const CostMatrix& cost, const Eigen::VectorXd& unassigned_cost);

}  // namespace datmo
