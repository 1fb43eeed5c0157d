// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/neighborhood.h"

#include <vector>

#include <gtest/gtest.h>

#include "datmo_fusion/grid/row_major.h"

namespace datmo::neighborhood_test {
namespace {

TEST(ForEachNeighbor, ACellAndTheEightAroundItRowByRow) {
  std::vector<CellIndex> visited;
  forEachNeighbor({5, -1}, [&visited](CellIndex cell) { visited.push_back(cell); });
  const std::vector<CellIndex> expected{{4, -2}, {5, -2}, {6, -2}, {4, -1}, {5, -1},
                                        {6, -1}, {4, 0},  {5, 0},  {6, 0}};
  EXPECT_EQ(visited, expected);
}

TEST(AnyNeighbor, StopsAtTheFirst) {
  int tested = 0;
  EXPECT_TRUE(anyNeighbor({0, 0}, 2, [&tested](CellIndex cell) {
    ++tested;
    return cell == CellIndex{-1, -2};
  }));
  EXPECT_EQ(tested, 2);
}

TEST(AnyNeighbor, SearchesNoFurtherThanItsReach) {
  const auto is_far = [](CellIndex cell) { return cell == CellIndex{2, 0}; };
  EXPECT_FALSE(anyNeighbor({0, 0}, 1, is_far));
  EXPECT_TRUE(anyNeighbor({0, 0}, 2, is_far));
  EXPECT_TRUE(anyNeighbor({2, 0}, 0, is_far)) << "the cell itself";
}

TEST(RowMajorIndex, CountsRowByRow) {
  EXPECT_EQ(rowMajorIndex(0, 0, 7), 0U);
  EXPECT_EQ(rowMajorIndex(6, 0, 7), 6U);
  EXPECT_EQ(rowMajorIndex(2, 3, 7), 23U);
}

}  // namespace
}  // namespace datmo::neighborhood_test
