// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/assignment/assignment.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace datmo::assignment_test {
namespace {

/// Least cost of the rows from `row` on, by exhaustive search.
double bruteForce(const CostMatrix& cost, const Eigen::VectorXd& none, int row,
                  std::vector<bool>& taken) {
  if (row == cost.rows()) {
    return 0.0;
  }
  double best = none[row] + bruteForce(cost, none, row + 1, taken);
  for (int column = 0; column < cost.cols(); ++column) {
    const auto index = static_cast<std::size_t>(column);
    if (!taken[index] && cost(row, column) < kForbidden) {
      taken[index] = true;
      best = std::min(best, cost(row, column) + bruteForce(cost, none, row + 1, taken));
      taken[index] = false;
    }
  }
  return best;
}

void expectValid(const Assignment& result, const CostMatrix& cost, const Eigen::VectorXd& none) {
  ASSERT_EQ(result.column_of_row.size(), static_cast<std::size_t>(cost.rows()));
  std::vector<bool> taken(static_cast<std::size_t>(cost.cols()), false);
  double sum = 0.0;
  for (int row = 0; row < cost.rows(); ++row) {
    const int column = result.column_of_row[static_cast<std::size_t>(row)];
    if (column == kUnassigned) {
      sum += none[row];
      continue;
    }
    ASSERT_LT(column, cost.cols());
    EXPECT_FALSE(taken[static_cast<std::size_t>(column)]) << "column given twice";
    taken[static_cast<std::size_t>(column)] = true;
    EXPECT_LT(cost(row, column), kForbidden);
    sum += cost(row, column);
  }
  EXPECT_NEAR(sum, result.cost, 1e-9);
}

class RandomAssignments : public testing::TestWithParam<double> {};

TEST_P(RandomAssignments, AreOptimal) {
  std::mt19937_64 engine(7);
  std::uniform_int_distribution<int> size(0, 6);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int run = 0; run < 2000; ++run) {
    CostMatrix cost(size(engine), size(engine));
    Eigen::VectorXd none(cost.rows());
    for (int row = 0; row < cost.rows(); ++row) {
      none[row] = 10.0 * uniform(engine) - 5.0;
      for (int column = 0; column < cost.cols(); ++column) {
        cost(row, column) =
            uniform(engine) < GetParam() ? kForbidden : 20.0 * uniform(engine) - 10.0;
      }
    }
    const Assignment result = solveAssignment(cost, none);
    expectValid(result, cost, none);
    std::vector<bool> taken(static_cast<std::size_t>(cost.cols()), false);
    EXPECT_NEAR(result.cost, bruteForce(cost, none, 0, taken), 1e-9) << cost << "\n\n" << none;
  }
}

INSTANTIATE_TEST_SUITE_P(ForbiddenShares, RandomAssignments, testing::Values(0.0, 0.3, 0.8, 1.0));

TEST(Assignment, GivesUpTheNearestForTheBestSum) {
  CostMatrix cost(2, 2);
  cost << 1.0, 2.0,  //
      2.0, 100.0;
  const Assignment result = solveAssignment(cost, Eigen::VectorXd::Constant(2, 1000.0));
  EXPECT_EQ(result.column_of_row, (std::vector<int>{1, 0}));
  EXPECT_DOUBLE_EQ(result.cost, 4.0);
}

TEST(Assignment, ARowGivesUpItsColumnAndStaysUnassigned) {
  CostMatrix cost(2, 1);
  cost << -5.0, -9.0;
  const Assignment result = solveAssignment(cost, Eigen::VectorXd::Zero(2));
  EXPECT_EQ(result.column_of_row, (std::vector<int>{kUnassigned, 0}));
}

TEST(Assignment, NothingToAssign) {
  EXPECT_TRUE(solveAssignment(CostMatrix(0, 0), Eigen::VectorXd(0)).column_of_row.empty());
  EXPECT_TRUE(solveAssignment(CostMatrix(0, 4), Eigen::VectorXd(0)).column_of_row.empty());
  const Assignment no_columns =
      solveAssignment(CostMatrix(2, 0), Eigen::VectorXd::Constant(2, 3.0));
  EXPECT_EQ(no_columns.column_of_row, (std::vector<int>{kUnassigned, kUnassigned}));
  EXPECT_DOUBLE_EQ(no_columns.cost, 6.0);
}

TEST(Assignment, AllForbidden) {
  const Assignment result =
      solveAssignment(CostMatrix::Constant(3, 2, kForbidden), Eigen::VectorXd::Zero(3));
  EXPECT_EQ(result.column_of_row, std::vector<int>(3, kUnassigned));
}

TEST(Assignment, TiesGoToTheEarlierColumnAndNotToNone) {
  const Assignment result =
      solveAssignment(CostMatrix::Constant(3, 3, 1.0), Eigen::VectorXd::Constant(3, 1.0));
  EXPECT_EQ(result.column_of_row, (std::vector<int>{0, 1, 2}));
}

TEST(Assignment, WrongSizesAreRefused) {
  EXPECT_THROW(solveAssignment(CostMatrix::Zero(2, 2), Eigen::VectorXd::Zero(3)),
               std::invalid_argument);
}

/// Every row prefers the same columns: the more rows, the longer the search of each.
CostMatrix samePreferences(int rows, int columns) {
  CostMatrix cost(rows, columns);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      cost(row, column) = (row + 1.0) * (column + 1.0);
    }
  }
  return cost;
}

TEST(Assignment, HundredsOfRowsWithTheSameColumnsEndUpOptimal) {
  const int size = 300;
  const Assignment result =
      solveAssignment(samePreferences(size, size), Eigen::VectorXd::Constant(size, 1e9));
  // The rearrangement inequality: the most expensive row gets the cheapest column.
  for (int row = 0; row < size; ++row) {
    EXPECT_EQ(result.column_of_row[static_cast<std::size_t>(row)], size - 1 - row);
  }
}

TEST(Assignment, CutShortItIsValidAndEveryRowGetsAFreeColumn) {
  const CostMatrix cost = samePreferences(40, 60);
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(40, 1e6);
  const Assignment best = solveAssignment(cost, none);
  const Assignment cut = solveAssignment(cost, none, 5000);
  EXPECT_FALSE(best.cut);
  EXPECT_TRUE(cut.cut);
  expectValid(cut, cost, none);
  EXPECT_GT(cut.cost, best.cost);
  EXPECT_EQ(std::count(cut.column_of_row.begin(), cut.column_of_row.end(), kUnassigned), 0);
  EXPECT_EQ(cut.column_of_row, solveAssignment(cost, none, 5000).column_of_row);
}

TEST(Assignment, CutShortARowStaysUnassignedRatherThanPayMore) {
  CostMatrix cost(3, 2);
  cost << 1.0, 2.0,  //
      3.0, 4.0,      //
      kForbidden, 1.0;
  const Assignment cut = solveAssignment(cost, Eigen::VectorXd::Constant(3, 3.5), 0);
  // The first row is assigned by its own scan; the others get what is free.
  EXPECT_EQ(cut.column_of_row, (std::vector<int>{0, kUnassigned, 1}));
}

TEST(Assignment, AThousandEqualColumnsNeedNoSecondSearch) {
  // For each row all columns are reached, and compared twice: for the choice of a column, and with
  // leaving the row unassigned.
  const Assignment result = solveAssignment(CostMatrix::Constant(300, 1000, 1.0),
                                            Eigen::VectorXd::Constant(300, 5.0), 3 * 300 * 1000);
  EXPECT_FALSE(result.cut);
  EXPECT_DOUBLE_EQ(result.cost, 300.0);
}

}  // namespace
}  // namespace datmo::assignment_test
