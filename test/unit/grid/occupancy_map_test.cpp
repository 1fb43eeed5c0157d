// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/occupancy_map.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "small_map.h"
#include <gtest/gtest.h>

namespace datmo::occupancy_map_test {
namespace {

using samples::scanTo;
using samples::smallMap;
using samples::updateWith;

TEST(OccupancyMapTest, IsUnknownInitially) {
  const OccupancyMap map(smallMap());
  EXPECT_DOUBLE_EQ(map.occupancy({3, 3}), 0.5);
  EXPECT_DOUBLE_EQ(map.occupancy({3000, 3}), 0.5);
  EXPECT_EQ(map.judge({3.5, 3.5}), PointState::kUnknown);
  EXPECT_FALSE(map.hitsAround({3.5, 3.5}));
}

TEST(OccupancyMapTest, OneBeamGivesTheInverseSensorModel) {
  OccupancyMap map(smallMap());
  updateWith(map, scanTo({{4.5, 0.5}}), PointState::kUnknown, Pose2(0.5, 0.0, 0.0));
  EXPECT_NEAR(map.occupancy({5, 0}), 0.8, 1e-6);
  for (int column = 0; column < 5; ++column) {
    EXPECT_NEAR(map.occupancy({column, 0}), 0.4, 1e-6) << column;
  }
  EXPECT_DOUBLE_EQ(map.occupancy({6, 0}), 0.5);
}

TEST(OccupancyMapTest, LogOddsOfIndependentScansAdd) {
  OccupancyMap map(smallMap());
  updateWith(map, scanTo({{4.5, 0.5}}, 0.0));
  updateWith(map, scanTo({{4.5, 0.5}}, 0.1));
  // Odds of 4 squared (eq. 3.1.11 with a prior of 1/2).
  EXPECT_NEAR(map.occupancy({4, 0}), 16.0 / 17.0, 1e-6);
}

TEST(OccupancyMapTest, OccupancyIsClampedOnBothSidesAlike) {
  OccupancyMap map(smallMap());
  for (int i = 0; i < 200; ++i) {
    updateWith(map, scanTo({{4.5, 0.5}}, 0.1 * i));
  }
  EXPECT_NEAR(map.occupancy({4, 0}), 0.98, 1e-5);
  EXPECT_NEAR(map.occupancy({2, 0}), 0.02, 1e-5);
}

TEST(OccupancyMapTest, AHitWinsOverABeamThatPassesInTheSameScan) {
  for (const bool hit_first : {true, false}) {
    OccupancyMap map(smallMap());
    const Point2 near(4.5, 0.5);
    const Point2 far(8.5, 0.5);
    updateWith(map, hit_first ? scanTo({near, far}) : scanTo({far, near}));
    EXPECT_NEAR(map.occupancy({4, 0}), 0.8, 1e-6);
  }
}

TEST(OccupancyMapTest, ACellCountsOnceInAScan) {
  OccupancyMap map(smallMap());
  updateWith(map, scanTo({{4.5, 0.5}, {4.6, 0.55}, {4.4, 0.45}}));
  EXPECT_NEAR(map.occupancy({4, 0}), 0.8, 1e-6);
  EXPECT_NEAR(map.occupancy({1, 0}), 0.4, 1e-6);
}

TEST(OccupancyMapTest, AMovingEndIsNotMapped) {
  OccupancyMap map(smallMap());
  updateWith(map, scanTo({{4.5, 0.5}}), PointState::kMoving);
  EXPECT_DOUBLE_EQ(map.occupancy({4, 0}), 0.5);
  EXPECT_NEAR(map.occupancy({2, 0}), 0.4, 1e-6);
}

TEST(OccupancyMapTest, ABeamWithoutReturnIsFreeToItsEnd) {
  OccupancyMap map(smallMap());
  updateWith(map, scanTo({{4.5, 0.5}}, 0.0, false));
  EXPECT_NEAR(map.occupancy({4, 0}), 0.4, 1e-6);
  EXPECT_DOUBLE_EQ(map.occupancy({5, 0}), 0.5);
}

TEST(OccupancyMapTest, AWideBeamFreesItsWholeSector) {
  OccupancyMapOptions options = smallMap();
  options.beam_width = 0.2;
  options.window.cell_size = 0.1;
  OccupancyMap map(options);
  updateWith(map, scanTo({{5.0, 0.05}}));
  for (double bearing = -0.09; bearing < 0.1; bearing += 0.01) {
    const Point2 point = 4.0 * Point2(std::cos(bearing), std::sin(bearing));
    EXPECT_LT(map.occupancy(map.window().cellAt(point)), 0.45) << bearing;
  }
  EXPECT_DOUBLE_EQ(map.occupancy(map.window().cellAt(4.0 * Point2(std::cos(0.2), std::sin(0.2)))),
                   0.5);
}

TEST(OccupancyMapTest, JudgesFreeStaticAndUnknown) {
  OccupancyMap map(smallMap());
  for (int i = 0; i <= 10; ++i) {
    updateWith(map, scanTo({{7.5, 0.5}}, 0.1 * i));
  }
  EXPECT_EQ(map.judge({7.5, 0.5}), PointState::kStatic);
  EXPECT_EQ(map.judge({3.5, 0.2}), PointState::kMoving);
  EXPECT_EQ(map.judge({3.5, 5.5}), PointState::kUnknown);
}

TEST(OccupancyMapTest, AStaticCellVouchesForItsNeighbors) {
  OccupancyMapOptions options = smallMap();
  for (const int reach : {0, 1}) {
    options.static_neighborhood = reach;
    OccupancyMap map(options);
    for (int i = 0; i <= 10; ++i) {
      updateWith(map, scanTo({{7.5, 0.5}}, 0.1 * i));
    }
    EXPECT_EQ(map.judge({6.5, 0.5}), reach == 1 ? PointState::kStatic : PointState::kMoving);
  }
}

TEST(OccupancyMapTest, AWideBeamIsMovingOnlyIfItsWholeFootprintWasFree) {
  OccupancyMapOptions options = smallMap();
  options.static_neighborhood = 0;
  OccupancyMap map(options);
  for (int i = 0; i <= 10; ++i) {
    updateWith(map, scanTo({{9.5, 0.5}, {9.5, 1.5}, {4.5, 3.5}}, 0.1 * i));
  }
  // Rows 0 and 1 are free at column 4; row 2 is free in part of it, row 3 holds an obstacle.
  EXPECT_EQ(map.judge({4.5, 0.5}), PointState::kMoving);
  EXPECT_EQ(map.judge({4.5, 0.5}, {0.0, 0.4}), PointState::kMoving);
  EXPECT_EQ(map.judge({4.5, 0.5}, {0.0, 1.4}), PointState::kUnknown) << "row -1 is not known";
  EXPECT_EQ(map.judge({4.5, 2.0}, {0.0, 1.6}), PointState::kStatic) << "row 3 is within reach";
}

TEST(OccupancyMapTest, CellsHitForAShortTimeAreNotStatic) {
  OccupancyMap map(smallMap());
  for (int i = 0; i <= 7; ++i) {
    updateWith(map, scanTo({{7.5, 0.5}}, 0.1 * i));
  }
  EXPECT_EQ(map.judge({7.5, 0.5}), PointState::kUnknown);  // 0.7 s; static after 0.8 s
  updateWith(map, scanTo({{7.5, 0.5}}, 0.9));
  EXPECT_EQ(map.judge({7.5, 0.5}), PointState::kStatic);
}

TEST(OccupancyMapTest, ANewOccupantOfAFreedCellIsYoungAgain) {
  OccupancyMap map(smallMap());
  for (int i = 0; i <= 10; ++i) {
    updateWith(map, scanTo({{7.5, 0.5}}, 0.1 * i));
  }
  for (int i = 11; i <= 40; ++i) {
    updateWith(map, scanTo({{9.5, 0.5}}, 0.1 * i));
  }
  EXPECT_EQ(map.judge({7.5, 0.5}), PointState::kMoving);
  for (int i = 41; i <= 44; ++i) {
    updateWith(map, scanTo({{7.5, 0.5}}, 0.1 * i));
  }
  EXPECT_NE(map.judge({7.5, 0.5}), PointState::kStatic);
}

TEST(OccupancyMapTest, HitsKeepTheirSubCellPosition) {
  OccupancyMap map(smallMap());
  updateWith(map, scanTo({{4.9, 0.2}, {5.1, 0.2}, {4.9, 0.4}, {5.1, 0.4}}));
  const auto hits = map.hitsAround({4.5, 0.5});
  ASSERT_TRUE(hits);
  EXPECT_DOUBLE_EQ(hits->hits, 4.0);
  EXPECT_TRUE(hits->mean.isApprox(Point2(5.0, 0.3), 1e-6));
  EXPECT_NEAR(hits->covariance(0, 0), 0.01, 1e-6);
  EXPECT_NEAR(hits->covariance(1, 1), 0.01, 1e-6);
  EXPECT_NEAR(hits->covariance(0, 1), 0.0, 1e-6);
}

TEST(OccupancyMapTest, TheNearestCellsHitsAreThoseWhoseMeanIsNearest) {
  OccupancyMap map(smallMap());
  updateWith(map, scanTo({{4.9, 0.5}, {5.8, 0.5}}));
  // In the cell of the second one, but nearer to the first one.
  const auto hits = map.nearestHits({5.2, 0.5});
  ASSERT_TRUE(hits);
  EXPECT_DOUBLE_EQ(hits->hits, 1.0);
  EXPECT_TRUE(hits->mean.isApprox(Point2(4.9, 0.5), 1e-6));
  EXPECT_FALSE(map.nearestHits({5.2, 8.5}));
}

TEST(OccupancyMapTest, ASurfaceHasTheMeanAgeOfItsHits) {
  OccupancyMap map(smallMap());
  for (const double seconds : {0.0, 1.0, 3.5, 5.0}) {
    const bool seen = seconds < 4.0;
    updateWith(map, scanTo({seen ? Point2(5.5, 0.5) : Point2(0.5, 5.5)}, seconds));
  }
  EXPECT_NEAR(map.nearestHits({5.5, 0.5})->age, 5.0 - 1.5, 1e-5);
  EXPECT_NEAR(map.nearestHits({0.5, 5.5})->age, 0.0, 1e-5);
  const OccupancyMap restored = OccupancyMap::restored(smallMap(), map.evidence());
  EXPECT_GT(restored.nearestHits({5.5, 0.5})->age, 1e5) << "older than any drive";
}

TEST(OccupancyMapTest, HitsMatureInTheTimeOfStaticAfter) {
  OccupancyMap map(smallMap());
  const auto maturity = [&] { return map.hitsAround({4.5, 0.5})->maturity; };
  updateWith(map, scanTo({{4.5, 0.5}}));
  EXPECT_DOUBLE_EQ(maturity(), 0.0);
  updateWith(map, scanTo({{4.5, 0.5}}, 0.2));
  EXPECT_NEAR(maturity(), 0.25, 1e-6);
  // Two hits of a new cell, beside two of 0.25.
  updateWith(map, scanTo({{5.5, 0.5}, {5.5, 0.5}}, 0.9));
  EXPECT_NEAR(maturity(), 0.125, 1e-6);
  // Three mature hits, two others.
  updateWith(map, scanTo({{4.5, 0.5}}, 1.0));
  EXPECT_NEAR(maturity(), 0.6, 1e-6);
}

TEST(OccupancyMapTest, WithoutStaticAfterAllHitsAreMature) {
  OccupancyMapOptions options = smallMap();
  options.static_after = 0.0;
  OccupancyMap map(options);
  updateWith(map, scanTo({{4.5, 0.5}}));
  EXPECT_DOUBLE_EQ(map.hitsAround({4.5, 0.5})->maturity, 1.0);
}

TEST(OccupancyMapTest, TheImageOfAMovedWindowShowsTheSameCells) {
  OccupancyMap map(smallMap());
  updateWith(map, scanTo({{4.5, 0.5}}));
  map.centerOn({3.0, -2.0});
  const GridWindow window = map.window();
  const std::vector<std::int8_t> image = map.occupancyImage();
  ASSERT_EQ(image.size(), static_cast<std::size_t>(window.columns * window.rows));
  const auto pixel = [&](int column, int row) {
    return image[static_cast<std::size_t>((row - window.corner.row) * window.columns + column -
                                          window.corner.column)];
  };
  EXPECT_EQ(pixel(4, 0), 80);
  EXPECT_EQ(pixel(2, 0), 40);
  EXPECT_EQ(pixel(4, 1), -1);
  EXPECT_EQ(std::count(image.begin(), image.end(), 80), 1);
}

TEST(OccupancyMapTest, BeamsThatLeaveTheWindowAreCut) {
  OccupancyMap map(smallMap());
  updateWith(map, scanTo({{400.0, 0.5}, {-400.0, 300.0}}));
  EXPECT_NEAR(map.occupancy({9, 0}), 0.4, 0.15);
}

TEST(OccupancyMapTest, RefusesBadOptions) {
  OccupancyMapOptions options = smallMap();
  options.window.cell_size = 0.0;
  EXPECT_THROW(OccupancyMap{options}, OptionError);
  options = smallMap();
  options.free_probability = 0.6;
  EXPECT_THROW(OccupancyMap{options}, OptionError);
}

TEST(OccupancyMapTest, RefusesMoreCellsThanMemoryHolds) {
  OccupancyMapOptions options;
  options.window.length = 2000.0;
  options.window.width = 2000.0;
  options.window.cell_size = 0.02;
  EXPECT_THROW(OccupancyMap{options}, OptionError);
}

}  // namespace
}  // namespace datmo::occupancy_map_test
