// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/pair_choice.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace datmo::evaluation::pair_choice_test {
namespace {

using Indices = std::vector<std::size_t>;

/// Greatest sum of gains of the pairs from `index` on, by exhaustive search.
double bruteForce(const std::vector<PairGain>& pairs, std::size_t index, std::vector<bool>& rows,
                  std::vector<bool>& columns) {
  if (index == pairs.size()) {
    return 0.0;
  }
  const PairGain& pair = pairs[index];
  double best = bruteForce(pairs, index + 1, rows, columns);
  if (!rows[pair.row] && !columns[pair.column]) {
    rows[pair.row] = columns[pair.column] = true;
    best = std::max(best, pair.gain + bruteForce(pairs, index + 1, rows, columns));
    rows[pair.row] = columns[pair.column] = false;
  }
  return best;
}

TEST(PairChoice, NothingToChooseFrom) { EXPECT_TRUE(choosePairs({}).empty()); }

TEST(PairChoice, DisjointPairsAreAllChosen) {
  EXPECT_EQ(choosePairs({{0, 7, 1.0}, {3, 2, 0.1}, {1, 0, 5.0}}), (Indices{0, 1, 2}));
}

TEST(PairChoice, TwoGoodPairsBeatOneBest) {
  // 4 + 4 versus 5 + nothing.
  EXPECT_EQ(choosePairs({{0, 0, 5.0}, {0, 1, 4.0}, {1, 0, 4.0}}), (Indices{1, 2}));
}

TEST(PairChoice, OneVeryGoodPairBeatsTwo) {
  EXPECT_EQ(choosePairs({{0, 0, 9.0}, {0, 1, 4.0}, {1, 0, 4.0}}), (Indices{0}));
}

TEST(PairChoice, ContestedAndUncontestedPairsTogether) {
  EXPECT_EQ(choosePairs({{5, 5, 1.0}, {0, 0, 1.0}, {0, 1, 2.0}, {9, 3, 1.0}}), (Indices{0, 2, 3}));
}

TEST(PairChoice, IsOptimalForRandomPairs) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int run = 0; run < 1000; ++run) {
    const double share = uniform(engine);
    std::vector<PairGain> pairs;
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t column = 0; column < 4; ++column) {
        if (uniform(engine) < share) {
          pairs.push_back({row, column, 0.1 + uniform(engine)});
        }
      }
    }
    double sum = 0.0;
    std::vector<bool> rows(4, false);
    std::vector<bool> columns(4, false);
    for (const std::size_t index : choosePairs(pairs)) {
      ASSERT_FALSE(rows[pairs[index].row] || columns[pairs[index].column]) << "given twice";
      rows[pairs[index].row] = columns[pairs[index].column] = true;
      sum += pairs[index].gain;
    }
    rows.assign(4, false);
    columns.assign(4, false);
    EXPECT_NEAR(sum, bruteForce(pairs, 0, rows, columns), 1e-12);
  }
}

}  // namespace
}  // namespace datmo::evaluation::pair_choice_test
