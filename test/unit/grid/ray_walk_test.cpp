// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/ray_walk.h"

#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::ray_walk_test {
namespace {

const GridWindow kWindow{1.0, 10, 10, {-5, -5}};

std::vector<CellIndex> walk(const Point2& from, const Point2& to) {
  std::vector<CellIndex> cells;
  walkRay(kWindow, from, to, [&](CellIndex cell) { cells.push_back(cell); });
  return cells;
}

TEST(RayWalkTest, APointIsOneCell) {
  EXPECT_EQ(walk({0.5, 0.5}, {0.5, 0.5}), (std::vector<CellIndex>{{0, 0}}));
}

TEST(RayWalkTest, StraightAlongAnAxis) {
  EXPECT_EQ(walk({0.5, 0.5}, {3.5, 0.5}), (std::vector<CellIndex>{{0, 0}, {1, 0}, {2, 0}, {3, 0}}));
  EXPECT_EQ(walk({0.5, 0.5}, {0.5, -1.5}), (std::vector<CellIndex>{{0, 0}, {0, -1}, {0, -2}}));
}

TEST(RayWalkTest, AFlatSlopeChangesRowWhereTheLineDoes) {
  // From (0.5, 0.5) with slope 1/2 the line meets row 1 at x = 1.5, in column 1.
  EXPECT_EQ(walk({0.5, 0.5}, {2.5, 1.5}), (std::vector<CellIndex>{{0, 0}, {1, 0}, {1, 1}, {2, 1}}));
}

TEST(RayWalkTest, EndsInTheEndCellAndEachStepSharesASide) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Point2 from(random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0));
    const Point2 to(random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0));
    const std::vector<CellIndex> cells = walk(from, to);
    ASSERT_EQ(cells.front(), kWindow.cellAt(from));
    ASSERT_EQ(cells.back(), kWindow.cellAt(to));
    for (std::size_t k = 1; k < cells.size(); ++k) {
      ASSERT_EQ(std::abs(cells[k].column - cells[k - 1].column) +
                    std::abs(cells[k].row - cells[k - 1].row),
                1);
    }
  }
}

TEST(RayWalkTest, EveryCellOfAWalkIsCrossedByTheLine) {
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const Point2 from(random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0));
    const Point2 to(random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0));
    const Point2 normal = Point2(from.y() - to.y(), to.x() - from.x()).normalized();
    const double half_cell = 0.5 * (std::abs(normal.x()) + std::abs(normal.y()));
    for (const CellIndex cell : walk(from, to)) {
      ASSERT_LE(std::abs(normal.dot(kWindow.centerOf(cell) - from)), half_cell + 1e-9);
    }
  }
}

TEST(RayWalkTest, ThroughCornersAndAlongBordersItStillArrives) {
  EXPECT_EQ(walk({0.0, 0.0}, {3.0, 3.0}).back(), (CellIndex{3, 3}));
  EXPECT_EQ(walk({3.0, 3.0}, {0.0, 0.0}).back(), (CellIndex{0, 0}));
  EXPECT_EQ(walk({-2.0, 1.0}, {2.0, 1.0}).size(), 5U);
}

}  // namespace
}  // namespace datmo::ray_walk_test
