// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/grid/grid_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::grid_motion_test {
namespace {

constexpr Percent kOccupied = 80;
constexpr Percent kFree = 20;

/// Cells of 0.5 m, columns and rows from -20 to 19.
const GridWindow kWindow{0.5, 40, 40, {-20, -20}};

SensorGrid allFree() {
  SensorGrid grid(Stamp{1}, kWindow);
  std::fill(grid.cells().begin(), grid.cells().end(), kFree);
  return grid;
}

std::vector<CellIndex> occupiedCells(const SensorGrid& grid) {
  std::vector<CellIndex> cells;
  grid.forEach([&](CellIndex cell, Percent percent) {
    if (isOccupied(percent)) {
      cells.push_back(cell);
    }
  });
  return cells;
}

/// Cells that touch no other one, well inside the window.
SensorGrid scattered(Random& random) {
  SensorGrid grid = allFree();
  for (int column = -11; column < 12; column += 4) {
    for (int row = -11; row < 12; row += 4) {
      const int aside = static_cast<int>(random.uniform(0.0, 2.0));
      grid.at({column + aside, row + 1 - aside}) = kOccupied;
    }
  }
  return grid;
}

TEST(GridMotionTest, NoMotionIsTheIdentity) {
  SensorGrid grid(Stamp{1}, kWindow);
  Random random(1);
  for (Percent& cell : grid.cells()) {
    cell = static_cast<Percent>(random.uniform(-1.0, 101.0));
  }
  const SensorGrid moved = movedGrid(grid, Stamp{2}, Pose2(), 0.0);
  EXPECT_EQ(moved.cells(), grid.cells());
  EXPECT_EQ(moved.window(), grid.window());
  EXPECT_EQ(moved.stamp(), Stamp{2});
}

TEST(GridMotionTest, StationaryCellsApproachWhenTheVehicleDrivesTowardThem) {
  SensorGrid grid = allFree();
  grid.at({10, 3}) = kOccupied;
  // 2 m ahead: the old frame is 2 m behind.
  const SensorGrid moved = movedGrid(grid, Stamp{2}, Pose2(-2.0, 0.0, 0.0), 0.0);
  ASSERT_EQ(occupiedCells(moved), std::vector<CellIndex>({{6, 3}}));
  // What has come into the window ahead has not been observed.
  EXPECT_EQ(moved.at({15, 0}), kFree);
  EXPECT_EQ(moved.at({16, 0}), kUnknownPercent);
}

TEST(GridMotionTest, AQuarterTurnTurnsTheGrid) {
  SensorGrid grid = allFree();
  grid.at({10, 3}) = kOccupied;  // center (5.25, 1.75)
  const SensorGrid moved = movedGrid(grid, Stamp{2}, Pose2(0.0, 0.0, kQuarterTurn), 0.0);
  EXPECT_EQ(occupiedCells(moved), std::vector<CellIndex>({{-4, 10}}));  // (-1.75, 5.25)
}

TEST(GridMotionTest, NoOccupiedCellIsLostByRotation) {
  Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const SensorGrid grid = scattered(random);
    const Pose2 motion(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                       random.uniform(-kPi, kPi));
    const SensorGrid moved = movedGrid(grid, Stamp{2}, motion, 0.0);
    EXPECT_GE(occupiedCells(moved).size(), occupiedCells(grid).size());
    for (const CellIndex cell : occupiedCells(grid)) {
      EXPECT_EQ(moved.at(kWindow.cellAt(motion * kWindow.centerOf(cell))), kOccupied);
    }
  }
}

TEST(GridMotionTest, ForthAndBackOccupiedCellsStayWithinACell) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const SensorGrid grid = scattered(random);
    const Pose2 motion(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                       random.uniform(-0.2, 0.2));
    const SensorGrid there = movedGrid(grid, Stamp{2}, motion, 0.0);
    const SensorGrid back = movedGrid(there, Stamp{1}, motion.inverse(), 0.0);
    for (const CellIndex cell : occupiedCells(grid)) {
      bool is_near = false;
      for (const CellIndex other : occupiedCells(back)) {
        is_near = is_near || (std::abs(other.column - cell.column) <= 1 &&
                              std::abs(other.row - cell.row) <= 1);
      }
      EXPECT_TRUE(is_near) << cell.column << ", " << cell.row;
    }
  }
}

TEST(GridMotionTest, CellsThatAMoverMayHaveReachedAreNotFree) {
  SensorGrid grid = allFree();
  grid.at({2, 3}) = kOccupied;
  grid.at({3, 3}) = 60;
  grid.at({4, 3}) = kUndecidedPercent;
  const SensorGrid moved = movedGrid(grid, Stamp{2}, Pose2(), 1.2);
  moved.forEach([&](CellIndex cell, Percent percent) {
    const Point2 center = kWindow.centerOf(cell);
    const double distance = std::min((center - kWindow.centerOf({2, 3})).norm(),
                                     (center - kWindow.centerOf({3, 3})).norm());
    const Percent before = grid.at(cell);
    EXPECT_EQ(percent, distance <= 1.2 && isFree(before) ? kUnknownPercent : before)
        << cell.column << ", " << cell.row;
  });
}

TEST(GridMotionTest, AMarginLargerThanTheGridLeavesNothingFree) {
  SensorGrid grid = allFree();
  grid.at({-20, -20}) = kOccupied;
  grid.at({19, 19}) = kOccupied;
  const SensorGrid moved = movedGrid(grid, Stamp{2}, Pose2(), 1000.0);
  for (const Percent percent : moved.cells()) {
    EXPECT_FALSE(isFree(percent));
  }
}

TEST(GridMotionTest, AMotionOutOfTheWindowLeavesAllUnknown) {
  for (const Pose2& motion : {Pose2(1e3, 0.0, 0.3), Pose2(0.0, -1e12, 0.0)}) {
    const SensorGrid moved = movedGrid(allFree(), Stamp{2}, motion, 0.0);
    for (const Percent percent : moved.cells()) {
      EXPECT_EQ(percent, kUnknownPercent);
    }
  }
}

}  // namespace
}  // namespace datmo::grid_motion_test
