// SPDX-License-Identifier: BSD-3-Clause
#include "small_map.h"
#include <gtest/gtest.h>

#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo::map_update_test {
namespace {

using samples::smallMap;

/// Contents of an instantaneous grid of 20 x 20 cells around the vehicle, second by second.
class MapUpdateTest : public testing::Test {
 protected:
  void show(const GridUpdate& grid_update, double seconds, const Pose2& base_in_map = Pose2()) {
    SensorGrid grid(Stamp::fromSeconds(1000.0 + seconds), smallMap().window.window());
    for (const CellIndex cell : free_) {
      grid.at(cell) = 20;
    }
    GridUpdate complete = grid_update;
    complete.grid = &grid;
    map_.update(complete, base_in_map);
  }

  static GridUpdate surfaceAt(const Point2& point) { return {nullptr, {point}, {}, {}, {}, {}}; }
  static GridUpdate cellAt(const Point2& point) { return {nullptr, {}, {point}, {}, {}, {}}; }
  static GridUpdate moverAt(const Point2& point) { return {nullptr, {}, {}, {point}, {}, {}}; }
  static GridUpdate refutedAt(const Point2& point) { return {nullptr, {}, {}, {}, {point}, {}}; }

  std::vector<CellIndex> free_;
  OccupancyMap map_{smallMap()};
};

TEST_F(MapUpdateTest, FreeCellsBecomeFreeWhereTheVehicleIs) {
  free_ = {{3, 0}};
  show({}, 0.0, Pose2(2.0, 1.0, 0.0));
  EXPECT_LT(map_.occupancy({5, 1}), 0.5);
  EXPECT_EQ(map_.occupancy({3, 0}), 0.5);
}

TEST_F(MapUpdateTest, AnExactPointIsASurfaceToMatchWith) {
  show(surfaceAt({4.2, 0.3}), 0.0);
  EXPECT_GT(map_.occupancy({4, 0}), 0.5);
  ASSERT_TRUE(map_.nearestHits({4.2, 0.3}).has_value());
  EXPECT_NEAR(map_.nearestHits({4.2, 0.3})->mean.x(), 4.2, 1e-6);
}

TEST_F(MapUpdateTest, ACellIsOccupiedAndNoSurface) {
  for (int i = 0; i < 20; ++i) {
    show(cellAt({4.5, 0.5}), 0.1 * i);
  }
  EXPECT_GT(map_.occupancy({4, 0}), 0.9);
  EXPECT_FALSE(map_.hitsAround({4.5, 0.5}).has_value());
  EXPECT_EQ(map_.judge({4.5, 0.5}), PointState::kUnknown) << "it has no age";
}

TEST_F(MapUpdateTest, ASurfaceInACellOfOthersAgesFromItsOwnFirstHit) {
  show(cellAt({4.5, 0.5}), 0.0);
  show(cellAt({4.5, 0.5}), 5.0);
  show(surfaceAt({4.5, 0.5}), 5.1);
  EXPECT_EQ(map_.judge({4.5, 0.5}), PointState::kUnknown);
  show(surfaceAt({4.5, 0.5}), 6.1);
  EXPECT_EQ(map_.judge({4.5, 0.5}), PointState::kStatic);
}

TEST_F(MapUpdateTest, WhereTheScannerWasOftenRefutedNothingMoves) {
  free_ = {{4, 0}, {8, 0}};
  for (int i = 0; i < 5; ++i) {
    show({}, 0.1 * i);
  }
  ASSERT_EQ(map_.judge({4.5, 0.5}), PointState::kMoving);
  show(refutedAt({4.5, 0.5}), 0.6);
  EXPECT_EQ(map_.judge({4.5, 0.5}), PointState::kMoving) << "once may be chance";
  show(refutedAt({4.5, 0.5}), 0.7);
  EXPECT_EQ(map_.judge({4.5, 0.5}), PointState::kUnknown);
  EXPECT_EQ(map_.judge({8.5, 0.5}), PointState::kMoving) << "elsewhere it is believed";
}

TEST_F(MapUpdateTest, WhereMuchTrafficPassesAFewRefutedEndsAreAMistake) {
  free_ = {{4, 0}};
  for (int i = 0; i < 30; ++i) {
    show(moverAt({4.5, 0.5}), 0.1 * i);
  }
  show(refutedAt({4.5, 0.5}), 3.1);
  show(refutedAt({4.5, 0.5}), 3.2);
  EXPECT_EQ(map_.judge({4.5, 0.5}), PointState::kMoving) << "2 of 32";
  show(refutedAt({4.5, 0.5}), 3.3);
  show(refutedAt({4.5, 0.5}), 3.4);
  EXPECT_EQ(map_.judge({4.5, 0.5}), PointState::kUnknown) << "4 of 34";
}

TEST_F(MapUpdateTest, RefutedEndsMayBeForgotten) {
  OccupancyMapOptions options = smallMap();
  options.ghost_after = 0;
  map_ = OccupancyMap(options);
  free_ = {{4, 0}};
  for (int i = 0; i < 5; ++i) {
    show(refutedAt({4.5, 0.5}), 0.1 * i);
  }
  EXPECT_EQ(map_.judge({4.5, 0.5}), PointState::kMoving);
}

TEST_F(MapUpdateTest, CellsOutsideTheWindowAreLeftOut) {
  GridUpdate grid_update = surfaceAt({400.0, 0.0});
  grid_update.cells = {{0.0, -400.0}};
  grid_update.refuted = {{-400.0, 0.0}};
  show(grid_update, 0.0);
  EXPECT_EQ(map_.occupancy({9, 0}), 0.5);
}

}  // namespace
}  // namespace datmo::map_update_test
