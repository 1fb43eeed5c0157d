#include "priced_assignment.h"

#include <stdexcept>
#include <string>

#include "augmenting_path.h"

namespace datmo {

namespace {

void giveCheapestFree(const CostMatrix& cost, const Eigen::VectorXd& unassigned_cost, int row,
                      PricedAssignment& assignment) {
  int cheapest = kUnassigned;
  double least = unassigned_cost[row];
  for (int column = 0; column < static_cast<int>(cost.cols()); ++column) {
    if (assignment.row_of_column[column] == kUnassigned && cost(row, column) < least) {
      cheapest = column;
      least = cost(row, column);
    }
  }
  assignment.column_of_row[row] = cheapest;
  if (cheapest != kUnassigned) {
    assignment.row_of_column[cheapest] = row;
  }
}

}  // namespace

double totalCost(const std::pmr::vector<int>& column_of_row, const CostMatrix& cost,
                 const Eigen::VectorXd& unassigned_cost) {
  double sum = 0.0;
  for (int row = 0; row < static_cast<int>(cost.rows()); ++row) {
    const int column = column_of_row[row];
    sum += column == kUnassigned ? unassigned_cost[row] : cost(row, column);
  }
  return sum;
}

bool assignAll(const CostMatrix& cost, const Eigen::VectorXd& unassigned_cost,
               std::int64_t most_work, AugmentingPath& path, PricedAssignment& assignment) {
  const int rows = static_cast<int>(cost.rows());
  int row = 0;
  for (; row < rows && path.work() <= most_work; ++row) {
    path.add(row, assignment);
  }
  const bool all = row == rows;
  for (; row < rows; ++row) {
    giveCheapestFree(cost, unassigned_cost, row, assignment);
  }
  return all;
}

void checkSizes(const CostMatrix& cost, const Eigen::VectorXd& unassigned_cost) {
  if (cost.rows() != unassigned_cost.size()) {
    throw std::invalid_argument(
        "costs of staying unassigned: " + std::to_string(unassigned_cost.size()) +
        ", expected one for each row: " + std::to_string(cost.rows()));
  }
}

}  // namespace datmo
