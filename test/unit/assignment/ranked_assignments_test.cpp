// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/assignment/ranked_assignments.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace datmo::ranked_assignments_test {
namespace {

constexpr double kTolerance = 1e-9;

struct Problem {
  CostMatrix cost;
  Eigen::VectorXd none;
};

/// Costs of all assignments, by exhaustive search.
class BruteForce {
 public:
  explicit BruteForce(const Problem& problem)
      : problem_(problem), taken_(static_cast<std::size_t>(problem.cost.cols()), false) {
    assign(0, 0.0);
    std::sort(costs_.begin(), costs_.end());
  }

  const std::vector<double>& costs() const { return costs_; }

 private:
  void assign(int row, double sum) {
    if (row == problem_.cost.rows()) {
      costs_.push_back(sum);
      return;
    }
    assign(row + 1, sum + problem_.none[row]);
    for (std::size_t column = 0; column < taken_.size(); ++column) {
      const double cost = problem_.cost(row, static_cast<int>(column));
      if (!taken_[column] && cost < kForbidden) {
        taken_[column] = true;
        assign(row + 1, sum + cost);
        taken_[column] = false;
      }
    }
  }

  const Problem& problem_;
  std::vector<bool> taken_;
  std::vector<double> costs_;
};

/// Sum of the costs; fails if a column is assigned twice or is forbidden.
double checkedCost(const Assignment& assignment, const Problem& problem) {
  std::set<int> taken;
  double sum = 0.0;
  for (int row = 0; row < problem.cost.rows(); ++row) {
    const int column = assignment.column_of_row[static_cast<std::size_t>(row)];
    if (column != kUnassigned) {
      EXPECT_TRUE(taken.insert(column).second) << "column given twice";
      EXPECT_LT(column, problem.cost.cols());
    }
    sum += column == kUnassigned ? problem.none[row] : problem.cost(row, column);
  }
  return sum;
}

void expectAll(const Problem& problem) {
  const BruteForce expected(problem);
  RankedAssignments ranked(problem.cost, problem.none);
  std::set<std::vector<int>> seen;
  for (const double cost : expected.costs()) {
    const auto assignment = ranked.next();
    ASSERT_TRUE(assignment) << "none left after " << seen.size();
    EXPECT_TRUE(seen.insert(assignment->column_of_row).second) << "returned twice";
    EXPECT_FALSE(assignment->cut);
    ASSERT_NEAR(assignment->cost, cost, kTolerance) << problem.cost << "\n\n" << problem.none;
    ASSERT_NEAR(checkedCost(*assignment, problem), cost, kTolerance);
  }
  EXPECT_FALSE(ranked.next());
  EXPECT_FALSE(ranked.next()) << "exhausted for good";
  EXPECT_FALSE(ranked.cut());
}

Problem randomProblem(int rows, int columns, double forbidden_share, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Problem problem{CostMatrix(rows, columns), Eigen::VectorXd(rows)};
  for (int row = 0; row < rows; ++row) {
    problem.none[row] = 10.0 * uniform(engine) - 5.0;
    for (int column = 0; column < columns; ++column) {
      problem.cost(row, column) =
          uniform(engine) < forbidden_share ? kForbidden : 20.0 * uniform(engine) - 10.0;
    }
  }
  return problem;
}

class AllAssignments : public testing::TestWithParam<double> {};

TEST_P(AllAssignments, ComeByRisingCostEachOnce) {
  std::mt19937_64 engine(11);
  std::uniform_int_distribution<int> size(0, 5);
  for (int run = 0; run < 500; ++run) {
    const int rows = size(engine);
    expectAll(randomProblem(rows, size(engine), GetParam(), engine));
  }
}

TEST_P(AllAssignments, AlsoForEqualCosts) {
  std::mt19937_64 engine(12);
  std::uniform_int_distribution<int> size(0, 4);
  for (int run = 0; run < 500; ++run) {
    const int rows = size(engine);
    Problem problem = randomProblem(rows, size(engine), GetParam(), engine);
    // Few distinct values: most of them are tied.
    problem.cost = (problem.cost / 8.0).array().round();
    problem.none = (problem.none / 8.0).array().round();
    expectAll(problem);
  }
}

INSTANTIATE_TEST_SUITE_P(ForbiddenShares, AllAssignments, testing::Values(0.0, 0.3, 0.8, 1.0));

TEST(RankedAssignments, OfMoreRowsThanColumnsOrFewer) {
  std::mt19937_64 engine(13);
  for (int run = 0; run < 30; ++run) {
    for (const auto& [rows, columns] : {std::pair{9, 2}, {8, 3}, {10, 3}, {3, 9}, {6, 5}}) {
      expectAll(randomProblem(rows, columns, 0.2, engine));
    }
  }
}

TEST(RankedAssignments, ThreeOfTwoRowsAndOneColumn) {
  CostMatrix cost(2, 1);
  cost << 1.0, 2.0;
  RankedAssignments ranked(cost, Eigen::Vector2d(3.0, 5.0));
  EXPECT_EQ(ranked.next()->column_of_row, (std::vector<int>{kUnassigned, 0}));            // 5
  EXPECT_EQ(ranked.next()->column_of_row, (std::vector<int>{0, kUnassigned}));            // 6
  EXPECT_EQ(ranked.next()->column_of_row, (std::vector<int>{kUnassigned, kUnassigned}));  // 8
  EXPECT_FALSE(ranked.next());
}

TEST(RankedAssignments, TheFirstIsTheSolversOwn) {
  std::mt19937_64 engine(14);
  for (int run = 0; run < 50; ++run) {
    const Problem problem = randomProblem(20, 15, 0.5, engine);
    const Assignment best = solveAssignment(problem.cost, problem.none);
    const auto first = RankedAssignments(problem.cost, problem.none).next();
    EXPECT_EQ(first->column_of_row, best.column_of_row);
    EXPECT_EQ(first->cost, best.cost);
  }
}

TEST(RankedAssignments, NoRowsHaveOneAssignment) {
  RankedAssignments ranked(CostMatrix(0, 3), Eigen::VectorXd(0));
  EXPECT_TRUE(ranked.next());
  EXPECT_FALSE(ranked.next());
}

TEST(RankedAssignments, LargeProblemsStayInOrder) {
  std::mt19937_64 engine(15);
  const Problem problem = randomProblem(60, 50, 0.2, engine);
  RankedAssignments ranked(problem.cost, problem.none);
  std::set<std::vector<int>> seen;
  double last = -kForbidden;
  for (int i = 0; i < 300; ++i) {
    const auto assignment = ranked.next();
    ASSERT_TRUE(assignment);
    EXPECT_TRUE(seen.insert(assignment->column_of_row).second);
    EXPECT_NEAR(checkedCost(*assignment, problem), assignment->cost, kTolerance);
    EXPECT_GE(assignment->cost, last - kTolerance);
    last = assignment->cost;
  }
}

TEST(RankedAssignments, TheSameInputGivesTheSameOrder) {
  const Problem problem{CostMatrix::Constant(4, 4, 1.0), Eigen::VectorXd::Constant(4, 1.0)};
  RankedAssignments one(problem.cost, problem.none);
  RankedAssignments two(problem.cost, problem.none);
  while (const auto assignment = one.next()) {
    EXPECT_EQ(assignment->column_of_row, two.next()->column_of_row);
  }
}

TEST(RankedAssignments, ContinueAfterAMove) {
  std::mt19937_64 engine(16);
  const Problem problem = randomProblem(3, 3, 0.0, engine);
  RankedAssignments ranked(problem.cost, problem.none);
  const double first = ranked.next()->cost;
  RankedAssignments moved = std::move(ranked);
  EXPECT_GT(moved.next()->cost, first);
}

TEST(RankedAssignments, StopAtTheWorkLimit) {
  std::mt19937_64 engine(17);
  const Problem problem = randomProblem(30, 30, 0.0, engine);
  const std::int64_t work = 20000;
  RankedAssignments ranked(problem.cost, problem.none, work);
  RankedAssignments all(problem.cost, problem.none);
  int count = 0;
  while (const auto assignment = ranked.next()) {
    EXPECT_EQ(assignment->column_of_row, all.next()->column_of_row);
    ++count;
  }
  EXPECT_TRUE(ranked.cut());
  EXPECT_GT(count, 1);
  EXPECT_TRUE(all.next());
}

TEST(RankedAssignments, WorkAndMemoryAreBoundedWhereFewPairsArePossible) {
  constexpr int kRows = 100;
  constexpr int kColumns = 400;
  constexpr std::int64_t kWork = 2'000'000;
  CostMatrix cost = CostMatrix::Constant(kRows, kColumns, kForbidden);
  for (int row = 0; row < kRows; ++row) {
    cost(row, 4 * row) = -2.0;
    cost(row, 4 * row + 1) = -1.0;
  }
  RankedAssignments ranked(cost, Eigen::VectorXd::Zero(kRows), kWork);
  int assignments = 0;
  while (ranked.next()) {
    ++assignments;
  }
  EXPECT_TRUE(ranked.cut());
  EXPECT_GT(assignments, 1);
  EXPECT_LE(assignments, kWork / kColumns) << "each is kept with a price for each column";
}

TEST(RankedAssignments, WithLittleWorkTheFirstIsTheSolversOwn) {
  std::mt19937_64 engine(18);
  const Problem problem = randomProblem(30, 30, 0.0, engine);
  const std::int64_t work = 60;
  RankedAssignments ranked(problem.cost, problem.none, work);
  const auto first = ranked.next();
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->cut);
  EXPECT_EQ(first->column_of_row, solveAssignment(problem.cost, problem.none, work).column_of_row);
  EXPECT_TRUE(ranked.cut());
  EXPECT_FALSE(ranked.next());
}

TEST(RankedAssignments, WrongSizesAreRefused) {
  EXPECT_THROW(RankedAssignments(CostMatrix::Zero(2, 2), Eigen::VectorXd::Zero(3)),
               std::invalid_argument);
}

}  // namespace
}  // namespace datmo::ranked_assignments_test
