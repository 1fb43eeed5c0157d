// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/rectangle_walk.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::rectangle_walk_test {
namespace {

const GridWindow kWindow{0.3, 60, 50, {-20, 7}};

std::vector<CellIndex> walk(const Rectangle& rectangle) {
  std::vector<CellIndex> cells;
  walkRectangle(kWindow, rectangle, [&](CellIndex cell) { cells.push_back(cell); });
  return cells;
}

/// Tests each cell of the window, row by row.
std::vector<CellIndex> bruteForce(const Rectangle& rectangle) {
  std::vector<CellIndex> cells;
  const Pose2 map_in_rectangle = rectangle.center.inverse();
  for (int row = kWindow.corner.row; row < kWindow.corner.row + kWindow.rows; ++row) {
    for (int column = kWindow.corner.column; column < kWindow.corner.column + kWindow.columns;
         ++column) {
      const Point2 center = map_in_rectangle * kWindow.centerOf({column, row});
      if (std::abs(center.x()) <= 0.5 * rectangle.length &&
          std::abs(center.y()) <= 0.5 * rectangle.width) {
        cells.push_back({column, row});
      }
    }
  }
  return cells;
}

TEST(RectangleWalkTest, AnUprightRectangleByHand) {
  // Centers lie at 0.15, 0.45, 0.75, ... m: two columns, three rows.
  EXPECT_EQ(walk({Pose2(0.3, 3.15, 0.0), 0.5, 0.7}),
            (std::vector<CellIndex>{{0, 9}, {1, 9}, {0, 10}, {1, 10}, {0, 11}, {1, 11}}));
}

TEST(RectangleWalkTest, AQuarterTurnSwapsLengthAndWidth) {
  EXPECT_EQ(walk({Pose2(0.31, 3.16, kQuarterTurn), 0.7, 0.5}),
            walk({Pose2(0.31, 3.16, 0.0), 0.5, 0.7}));
}

TEST(RectangleWalkTest, FindsWhatBruteForceFindsWhereverTheRectangleLies) {
  Random random(1);
  std::size_t cells = 0;
  for (int i = 0; i < 3000; ++i) {
    const Rectangle rectangle{
        Pose2(random.uniform(-12.0, 18.0), random.uniform(-5.0, 22.0), random.uniform(-kPi, kPi)),
        random.uniform(0.05, 25.0), random.uniform(0.05, 4.0)};
    const std::vector<CellIndex> expected = bruteForce(rectangle);
    ASSERT_EQ(walk(rectangle), expected) << "rectangle " << i;
    cells += expected.size();
  }
  EXPECT_GT(cells, 100000U);
}

TEST(RectangleWalkTest, OutsideOfTheWindowAndWithoutANumberThereIsNothing) {
  EXPECT_TRUE(walk({Pose2(1.0e9, -1.0e9, 0.3), 20.0, 1.0}).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(walk({Pose2(nan, 3.0, 0.3), 20.0, 1.0}).empty());
  EXPECT_TRUE(walk({Pose2(0.0, nan, 0.3), 20.0, 1.0}).empty());
}

TEST(RectangleWalkTest, ARectangleOverAllIsTheWindow) {
  EXPECT_EQ(walk({Pose2(0.0, 9.0, 0.7), 1.0e6, 1.0e6}).size(), 60U * 50U);
}

}  // namespace
}  // namespace datmo::rectangle_walk_test
