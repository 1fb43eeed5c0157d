// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/rolling_grid.h"

#include <array>
#include <limits>
#include <set>

#include <gtest/gtest.h>

namespace datmo::rolling_grid_test {
namespace {

/// Every cell of the window holds its own index, so that it is distinguishable from any other.
int tag(CellIndex cell) { return 1000 * cell.column + cell.row; }

constexpr int kEmpty = -999999;

class RollingGridTest : public ::testing::Test {
 protected:
  RollingGrid<int> grid_{7, 5, 0.5, kEmpty};

  template <typename Visit>
  void forEachCell(Visit&& visit) {
    const GridWindow window = grid_.window();
    for (int column = 0; column < window.columns; ++column) {
      for (int row = 0; row < window.rows; ++row) {
        visit(CellIndex{window.corner.column + column, window.corner.row + row});
      }
    }
  }

  void fill() {
    forEachCell([this](CellIndex cell) { grid_.at(cell) = tag(cell); });
  }

  /// After a move: cells that stayed keep their content, the others are empty.
  void expectMoved(const Point2& center) {
    fill();
    const GridWindow before = grid_.window();
    grid_.centerOn(center);
    forEachCell([&](CellIndex cell) {
      EXPECT_EQ(grid_.at(cell), before.contains(cell) ? tag(cell) : kEmpty)
          << "cell " << cell.column << ", " << cell.row;
    });
  }
};

TEST_F(RollingGridTest, StartsEmptyRoundTheOrigin) {
  forEachCell([this](CellIndex cell) { EXPECT_EQ(grid_.at(cell), kEmpty); });
  EXPECT_TRUE(grid_.window().contains(grid_.window().cellAt({0.0, 0.0})));
}

TEST_F(RollingGridTest, ACellHoldsItsLowerLeftBorder) {
  const GridWindow& window = grid_.window();
  EXPECT_EQ(window.cellAt({0.0, 0.0}), (CellIndex{0, 0}));
  EXPECT_EQ(window.cellAt({0.4999, 0.5}), (CellIndex{0, 1}));
  EXPECT_EQ(window.cellAt({-0.0001, -0.5}), (CellIndex{-1, -1}));
  EXPECT_TRUE(window.centerOf({-1, 2}).isApprox(Point2(-0.25, 1.25)));
}

TEST_F(RollingGridTest, MovesInEveryDirectionKeepTheOverlap) {
  for (int x = -9; x <= 9; ++x) {
    for (int y = -7; y <= 7; ++y) {
      expectMoved(Point2(0.5 * x, 0.5 * y));
    }
  }
}

TEST_F(RollingGridTest, AMoveByLessThanACellKeepsAll) {
  grid_.centerOn({0.25, 0.25});
  fill();
  grid_.centerOn({0.49, 0.01});
  forEachCell([this](CellIndex cell) { EXPECT_EQ(grid_.at(cell), tag(cell)); });
}

TEST_F(RollingGridTest, AFarMoveEmptiesAll) {
  fill();
  grid_.centerOn({1.0e6, -1.0e6});
  forEachCell([this](CellIndex cell) { EXPECT_EQ(grid_.at(cell), kEmpty); });
}

TEST_F(RollingGridTest, DistantPositionsAreClampedToTheIndexLimit) {
  constexpr int kLimit = GridWindow::kMaxCell;
  const GridWindow& window = grid_.window();
  EXPECT_EQ(window.cellAt({1.0e300, -1.0e300}), (CellIndex{kLimit, -kLimit}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(window.cellAt({nan, std::numeric_limits<double>::infinity()}),
            (CellIndex{-kLimit, kLimit}));
  expectMoved({1.0e12, -1.0e12});
  grid_.at(window.corner) = 1;
  grid_.centerOn({0.0, 0.0});
  forEachCell([this](CellIndex cell) { EXPECT_EQ(grid_.at(cell), kEmpty); });
}

TEST_F(RollingGridTest, LeavingCellsAreVisitedOnceBeforeTheMove) {
  for (const Point2& center : {Point2(0.1, 0.1), Point2(1.0, -0.5), Point2(-2.0, 7.0)}) {
    grid_.centerOn({0.0, 0.0});
    fill();
    const GridWindow before = grid_.window();
    const GridWindow after = grid_.windowOn(center);
    std::set<int> left;
    grid_.centerOn(center, [&](CellIndex cell) {
      EXPECT_EQ(grid_.window().corner, before.corner);
      EXPECT_EQ(grid_.at(cell), tag(cell));
      EXPECT_FALSE(after.contains(cell));
      EXPECT_TRUE(left.insert(tag(cell)).second);
    });
    EXPECT_EQ(grid_.window().corner, after.corner);
    std::size_t kept = 0;
    forEachCell([&](CellIndex cell) { kept += grid_.at(cell) == kEmpty ? 0U : 1U; });
    EXPECT_EQ(left.size() + kept, 35U);
  }
}

TEST_F(RollingGridTest, OutsideReadsAsEmpty) {
  fill();
  EXPECT_EQ(grid_.atOrEmpty({1000, 0}), kEmpty);
  EXPECT_EQ(grid_.atOrEmpty({1, 1}), tag({1, 1}));
}

TEST_F(RollingGridTest, ManyCellsAreReadAsSingleOnes) {
  constexpr int kFar = GridWindow::kMaxCell;
  for (const Point2& center : {Point2(0.0, 0.0), Point2(1.0, -0.5), Point2(-200.0, 70.0)}) {
    grid_.centerOn(center);
    fill();
    const CellIndex corner = grid_.window().corner;
    for (int column = -2; column < 9; ++column) {
      const int x = corner.column + column;
      const std::array<int, 8> columns{x, x, x, x, x, x, kFar, -kFar};
      const std::array<int, 8> rows{corner.row - 1, corner.row,     corner.row + 3, corner.row + 4,
                                    corner.row + 5, corner.row + 9, corner.row + 1, -kFar};
      const std::array<unsigned, 8> indices = grid_.indicesOf(columns, rows);
      for (std::size_t i = 0; i < indices.size(); ++i) {
        EXPECT_EQ(grid_.atIndex(indices[i]), grid_.atOrEmpty({columns[i], rows[i]}));
      }
    }
  }
}

}  // namespace
}  // namespace datmo::rolling_grid_test
