// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/grid_resampling.h"

#include <map>
#include <utility>

#include <gtest/gtest.h>

namespace datmo::grid_resampling_test {
namespace {

constexpr GridWindow kSource{0.5, 6, 4, {-3, -2}};
constexpr GridWindow kTarget{0.5, 40, 30, {-20, -15}};

SensorGrid numbered() {
  SensorGrid grid({}, kSource);
  for (std::size_t i = 0; i < grid.cells().size(); ++i) {
    grid.cells()[i] = static_cast<Percent>(i);
  }
  return grid;
}

using Cells = std::map<std::pair<int, int>, Percent>;

Cells resampled(const SensorGrid& grid, const Pose2& pose, const GridWindow& window) {
  Cells cells;
  resample(grid, pose, window, [&](CellIndex cell, Percent percent) {
    EXPECT_TRUE(window.contains(cell));
    EXPECT_TRUE(cells.emplace(std::make_pair(cell.column, cell.row), percent).second);
  });
  return cells;
}

TEST(Resample, ByNothingEveryCellIsItself) {
  const SensorGrid grid = numbered();
  const Cells cells = resampled(grid, Pose2(), kTarget);
  EXPECT_EQ(cells.size(), 24U);
  grid.forEach([&](CellIndex cell, Percent percent) {
    EXPECT_EQ(cells.at({cell.column, cell.row}), percent);
  });
}

TEST(Resample, ByWholeCellsTheGridIsShifted) {
  const Cells cells = resampled(numbered(), Pose2(1.0, -1.5, 0.0), kTarget);
  EXPECT_EQ(cells.size(), 24U);
  EXPECT_EQ(cells.at({-1, -5}), 0);  // (-3, -2) moved by (2, -3)
  EXPECT_EQ(cells.at({4, -2}), 23);
}

TEST(Resample, ByAQuarterTurnRowsBecomeColumns) {
  const Cells cells = resampled(numbered(), Pose2(0.0, 0.0, kQuarterTurn), kTarget);
  EXPECT_EQ(cells.size(), 24U);
  // The center of (-3, -2) is (-1.25, -0.75); turned to the left it is (0.75, -1.25).
  EXPECT_EQ(cells.at({1, -3}), 0);
}

TEST(Resample, EachCellTakesTheValueAtItsCenter) {
  const SensorGrid grid = numbered();
  const Pose2 pose(2.3, -1.1, 0.7);
  const Cells cells = resampled(grid, pose, kTarget);
  EXPECT_NEAR(static_cast<double>(cells.size()), 24.0, 4.0);
  for (const auto& [cell, percent] : cells) {
    const Point2 position = pose.inverse() * kTarget.centerOf({cell.first, cell.second});
    EXPECT_EQ(percent, grid.at(kSource.cellAt(position)));
  }
}

TEST(Resample, CellsOutsideTheWindowAreNotVisited) {
  EXPECT_TRUE(resampled(numbered(), Pose2(100.0, 0.0, 0.3), kTarget).empty());
  EXPECT_EQ(resampled(numbered(), Pose2(10.0, 0.0, 0.0), kTarget).size(), 12U);
}

TEST(Resample, CellsMayBeOfAnotherSize) {
  const GridWindow fine{0.25, 100, 100, {-50, -50}};
  EXPECT_EQ(resampled(numbered(), Pose2(), fine).size(), 96U);
}

}  // namespace
}  // namespace datmo::grid_resampling_test
