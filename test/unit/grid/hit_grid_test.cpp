// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/hit_grid.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::hit_grid_test {
namespace {

constexpr Stamp kAnyTime{};

HitGridOptions smallOptions(int max_hits) {
  HitGridOptions options;
  options.window = {6.0, 4.5, 0.3};
  options.max_hits = max_hits;
  options.min_age = 0.0;
  return options;
}

template <typename Visit>
void forEachCell(const GridWindow& window, Visit&& visit) {
  for (int row = window.corner.row; row < window.corner.row + window.rows; ++row) {
    for (int column = window.corner.column; column < window.corner.column + window.columns;
         ++column) {
      visit(CellIndex{column, row});
    }
  }
}

/// The thesis's S from the counts, and its maximum.
void expectSumsOf(const HitGrid& grid) {
  int highest = 0;
  forEachCell(grid.window(), [&](CellIndex cell) {
    int sum = 0;
    for (int row = -1; row <= 1; ++row) {
      for (int column = -1; column <= 1; ++column) {
        sum += grid.hits({cell.column + column, cell.row + row});
      }
    }
    ASSERT_EQ(grid.smoothed(cell), sum) << "cell " << cell.column << ", " << cell.row;
    highest = std::max(highest, sum);
  });
  ASSERT_EQ(grid.highest(), highest);
}

TEST(HitGridTest, AHitCountsInItsCellAndInTheSumsAround) {
  HitGrid grid(smallOptions(0));
  grid.add({0.15, 0.15}, kAnyTime);
  grid.add({0.2, 0.1}, kAnyTime);
  grid.add({0.45, 0.15}, kAnyTime);
  EXPECT_EQ(grid.hits({0, 0}), 2);
  EXPECT_EQ(grid.hits({1, 0}), 1);
  EXPECT_EQ(grid.smoothed({0, 0}), 3);
  EXPECT_EQ(grid.smoothed({-1, -1}), 2);
  EXPECT_EQ(grid.smoothed({2, 1}), 1);
  EXPECT_EQ(grid.smoothed({3, 0}), 0);
  EXPECT_EQ(grid.highest(), 3);
  EXPECT_TRUE(grid.meanHit({0, 0}).isApprox(Point2(0.175, 0.125), 1e-6));
}

TEST(HitGridTest, ValuesBelowATenthOfTheHighestAreCut) {
  HitGrid grid(smallOptions(0));
  for (int i = 0; i < 20; ++i) {
    grid.add({-2.0, 0.1}, kAnyTime);
  }
  grid.add({2.0, 0.1}, kAnyTime);
  const CellIndex once = grid.window().cellAt({2.0, 0.1});
  EXPECT_EQ(grid.smoothed(once), 1);
  EXPECT_EQ(grid.cutSmoothed(once), 0);
  grid.add({2.0, 0.1}, kAnyTime);
  EXPECT_EQ(grid.cutSmoothed(once), 2);
  EXPECT_EQ(grid.cutSmoothed({0, 0}), 0);
}

TEST(HitGridTest, TransientHitsAreCutAndLastingOnesAreNot) {
  HitGridOptions options = smallOptions(0);
  options.min_age = 1.0;
  HitGrid grid(options);
  const auto at = [](double seconds) { return Stamp::fromSeconds(100.0 + seconds); };
  for (const double seconds : {0.0, 0.3, 0.6}) {
    grid.add({0.1, 0.1}, at(seconds));
  }
  EXPECT_EQ(grid.smoothed({0, 0}), 3);
  EXPECT_EQ(grid.cutSmoothed({0, 0}), 0);
  grid.add({0.4, 0.1}, at(1.1));  // beside it
  EXPECT_EQ(grid.cutSmoothed({0, 0}), 4);
  EXPECT_EQ(grid.cutSmoothed({1, 0}), 4);
  EXPECT_EQ(grid.cutSmoothed({2, 0}), 0) << "has been hit around it once";
}

TEST(HitGridTest, ACellCountsUpToItsLimitAndItsMeanFollows) {
  HitGrid grid(smallOptions(5));
  for (int i = 0; i < 100; ++i) {
    grid.add({0.1, 0.1}, kAnyTime);
  }
  EXPECT_EQ(grid.highest(), 5);
  for (int i = 0; i < 100; ++i) {
    grid.add({0.2, 0.1}, kAnyTime);
  }
  EXPECT_EQ(grid.hits({0, 0}), 5);
  EXPECT_TRUE(grid.meanHit({0, 0}).isApprox(Point2(0.2, 0.1), 1e-6));
}

TEST(HitGridTest, SumsAndHighestStayExactWhereverTheWindowMoves) {
  Random random(3);
  for (const int max_hits : {0, 4}) {
    HitGrid grid(smallOptions(max_hits));
    Point2 center = Point2::Zero();
    for (int i = 0; i < 150; ++i) {
      for (int hit = 0; hit < 60; ++hit) {
        // Some points are hit more often than others; some hits are outside.
        grid.add(center + Point2(random.normal(1.5), random.normal(1.5)), kAnyTime);
      }
      expectSumsOf(grid);
      center += Point2(random.normal(0.7), random.normal(0.7));
      grid.centerOn(center);
      expectSumsOf(grid);
    }
  }
}

TEST(HitGridTest, AFarMoveForgetsAll) {
  HitGrid grid(smallOptions(0));
  grid.add({0.1, 0.1}, kAnyTime);
  grid.centerOn({1.0e12, 5.0});
  EXPECT_EQ(grid.highest(), 0);
  grid.centerOn({0.0, 0.0});
  EXPECT_EQ(grid.hits({0, 0}), 0);
}

TEST(HitGridTest, AScanCountsFromItsPoseWhateverTheMapSays) {
  HitGrid grid(smallOptions(0));
  LabeledScan scan;
  scan.base_in_map.pose = Pose2(100.0, 50.0, kQuarterTurn);
  for (const PointState state : {PointState::kStatic, PointState::kMoving, PointState::kUnknown}) {
    ScanPoint point;
    point.position = {1.0, 0.0};
    point.state = state;
    scan.points.push_back(point);
  }
  grid.update(scan);
  EXPECT_EQ(grid.hits(grid.window().cellAt({100.0, 51.0})), 3);
  EXPECT_TRUE(grid.window().contains(grid.window().cellAt({100.0, 50.0})));
}

TEST(HitGridTest, StartsOver) {
  HitGrid grid(smallOptions(0));
  grid.centerOn({10.0, 0.0});
  grid.add({10.0, 0.0}, kAnyTime);
  grid.reset();
  EXPECT_EQ(grid.highest(), 0);
  EXPECT_TRUE(grid.window().contains({0, 0}));
  expectSumsOf(grid);
}

TEST(HitGridTest, RefusesBadOptions) {
  EXPECT_THROW(HitGrid{smallOptions(-1)}, OptionError);
  HitGridOptions options = smallOptions(0);
  options.cut_share = 1.5;
  EXPECT_THROW(HitGrid{options}, OptionError);
}

}  // namespace
}  // namespace datmo::hit_grid_test
