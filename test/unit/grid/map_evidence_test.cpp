// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <vector>

#include "small_map.h"
#include <gtest/gtest.h>

namespace datmo::map_evidence_test {
namespace {

using samples::scanTo;
using samples::smallMap;
using samples::updateWith;

/// A static surface 4 m ahead of the origin, and free cells before it.
OccupancyMap mapWithSurface() {
  OccupancyMap map{smallMap()};
  for (const double seconds : {0.0, 0.5, 1.0, 1.5}) {
    updateWith(map, scanTo({{4.3, 0.4}}, seconds));
  }
  return map;
}

void expectSurface(const OccupancyMap& map) {
  EXPECT_EQ(map.stateOf({4, 0}), CellState::kStatic);
  EXPECT_EQ(map.stateOf({2, 0}), CellState::kFree);
  const auto hits = map.nearestHits({4.5, 0.5});
  ASSERT_TRUE(hits);
  EXPECT_NEAR(hits->mean.x(), 4.3, 1e-5);
  EXPECT_NEAR(hits->mean.y(), 0.4, 1e-5);
  EXPECT_NEAR(hits->hits, 4.0, 1e-5);
  EXPECT_EQ(hits->maturity, 1.0);
}

TEST(MapEvidenceTest, ARestoredMapKnowsTheSame) {
  const OccupancyMap map = mapWithSurface();
  const OccupancyMap restored = OccupancyMap::restored(smallMap(), map.evidence());
  expectSurface(restored);
  EXPECT_EQ(restored.occupancyImage(), map.occupancyImage());
}

TEST(MapEvidenceTest, CellsThatLeftTheWindowAreInTheEvidence) {
  OccupancyMap map = mapWithSurface();
  map.centerOn({100.0, 0.0});
  EXPECT_EQ(map.stateOf({4, 0}), CellState::kUnknown);
  expectSurface(OccupancyMap::restored(smallMap(), map.evidence()));
  EXPECT_EQ(map.extent().corner.column, 0);
  EXPECT_EQ(map.extent().columns, 5);
}

TEST(MapEvidenceTest, ItIsReloadedOnlyIntoARestoredMap) {
  OccupancyMap map = mapWithSurface();
  OccupancyMap restored = OccupancyMap::restored(smallMap(), map.evidence());
  for (OccupancyMap* moved : {&map, &restored}) {
    moved->centerOn({100.0, 50.0});
    moved->centerOn({2.0, 1.0});
  }
  EXPECT_EQ(map.stateOf({4, 0}), CellState::kUnknown);
  expectSurface(restored);
}

TEST(MapEvidenceTest, AMergedMapAddsWhatItKnowsWhereItsFrameIs) {
  OccupancyMap map{smallMap()};
  updateWith(map, scanTo({{-6.0, -6.0}}, -50.0));
  map.merge(mapWithSurface(), Pose2(1.0, -2.0, degrees(90.0)));
  const auto hits = map.nearestHits({0.5, 2.5});  // (4.3, 0.4), turned and moved
  ASSERT_TRUE(hits);
  EXPECT_NEAR(hits->mean.x(), 0.6, 1e-5);
  EXPECT_NEAR(hits->mean.y(), 2.3, 1e-5);
  EXPECT_NEAR(hits->hits, 4.0, 1e-5);
  EXPECT_EQ(hits->maturity, 1.0);
  EXPECT_NEAR(hits->age, 0.75, 1e-4) << "mean of the hits of 1.5 s";
  EXPECT_EQ(map.stateOf({0, 2}), CellState::kStatic);
  EXPECT_EQ(map.stateOf({0, 0}), CellState::kFree);
  EXPECT_EQ(map.stateOf({-6, -6}), CellState::kUnknown) << "seen once";
}

TEST(MapEvidenceTest, WhatBothMapsKnowIsAddedUp) {
  OccupancyMap map = mapWithSurface();
  const double before = map.occupancy({4, 0});
  map.merge(mapWithSurface(), Pose2());
  EXPECT_GE(map.occupancy({4, 0}), before);
  EXPECT_NEAR(map.nearestHits({4.5, 0.5})->hits, 8.0, 1e-5);
  EXPECT_LT(map.occupancy({2, 0}), mapWithSurface().occupancy({2, 0}));
}

TEST(MapEvidenceTest, NoSurfaceIsLostWhereverItsCellFalls) {
  std::vector<Point2> ends = {{5.3, -4.6}};  // a post
  for (double y = -4.0; y <= 4.0; y += 0.5) {
    ends.emplace_back(4.3, y);  // a wall
  }
  OccupancyMap newer{smallMap()};
  for (int i = 0; i < 12; ++i) {  // until free cells are as certain as occupied ones
    updateWith(newer, scanTo(ends, 0.1 * i));
  }
  for (const double turn : {0.0, 0.3, 0.8}) {
    const Pose2 newer_in_map(0.13, 0.37, turn);
    OccupancyMap map{smallMap()};
    map.merge(newer, newer_in_map);
    const std::vector<Point2> surfaces = map.staticSurfaces();
    for (const Point2& end : ends) {
      const Point2 at = newer_in_map * end;
      EXPECT_TRUE(std::any_of(surfaces.begin(), surfaces.end(),
                              [&](const Point2& surface) {
                                return (surface - at).norm() < 0.6;  // of the two ends in a cell
                              }))
          << turn << ": " << at.transpose();
    }
  }
}

TEST(MapEvidenceTest, AnEmptyMapMergesNothing) {
  OccupancyMap map = mapWithSurface();
  map.merge(OccupancyMap{smallMap()}, Pose2());
  expectSurface(map);
}

TEST(MapEvidenceTest, RevisitedCellsAreInTheEvidence) {
  OccupancyMap map = mapWithSurface();
  const std::size_t known = map.evidence().cells.size();
  map.centerOn({100.0, 50.0});
  EXPECT_EQ(map.evidence().cells.size(), known);
  map.centerOn({2.0, 1.0});
  EXPECT_EQ(map.evidence().cells.size(), known) << "a loop that ends where it began";
  expectSurface(OccupancyMap::restored(smallMap(), map.evidence()));
}

TEST(MapEvidenceTest, AnotherWindowShowsTheSame) {
  OccupancyMap map = mapWithSurface();
  map.setWindow({1.0, 3, 3, {50, 50}});
  EXPECT_EQ(map.stateOf({4, 0}), CellState::kUnknown);
  map.setWindow(map.extent());
  expectSurface(map);
}

TEST(MapEvidenceTest, ChangingWindowsRepeatedlyDoesNotMakeItGrow) {
  OccupancyMapOptions options = smallMap();
  options.max_tiles = 4;
  options.tile_file.folder.clear();
  OccupancyMap map = OccupancyMap::restored(options, mapWithSurface().evidence());
  const std::size_t restored = map.evidence().cells.size();
  std::size_t max_known = 0;
  // A vehicle that is repeatedly lost in new areas: each time the whole map is searched, and then
  // mapping continues in one part.
  const GridWindow part = map.window();
  for (int i = 1; i <= 40; ++i) {
    map.setWindow(map.extent());
    map.setWindow(part);
    const Pose2 pose(100.0 * i, 0.0, 0.0);
    map.centerOn(pose.position());
    updateWith(map, scanTo({{4.3, 0.4}}, 0.1 * i), PointState::kUnknown, pose);
    max_known = std::max(max_known, map.evidence().cells.size());
  }
  // A scan makes five cells known, which lie in at most two tiles.
  EXPECT_LE(max_known, restored + 5U * (4U + 1U));
  EXPECT_GT(map.forgottenTiles(), 30U);
  map.centerOn({0.0, 0.0});
  expectSurface(map);
}

TEST(MapEvidenceTest, TheNewWindowHoldsCellsThatFitNowhereElse) {
  OccupancyMapOptions options = smallMap();
  options.max_tiles = 1;
  options.tile_file.folder.clear();
  OccupancyMap map = OccupancyMap::restored(options, mapWithSurface().evidence());
  for (int i = 1; i <= 3; ++i) {
    const Pose2 pose(40.0 * i, 0.0, 0.0);
    map.centerOn(pose.position());
    updateWith(map, scanTo({{4.3, 0.4}}, 0.1 * i), PointState::kUnknown, pose);
  }
  const std::size_t known = map.evidence().cells.size();
  map.setWindow(map.extent());
  EXPECT_EQ(map.evidence().cells.size(), known);
  expectSurface(map);
}

TEST(MapEvidenceTest, TilesBeyondTheMemoryLimitAreInTheFile) {
  OccupancyMapOptions options = smallMap();
  const auto drive = [](OccupancyMap& map) {
    for (int i = 0; i <= 20; ++i) {
      const Pose2 pose(40.0 * i, 0.0, 0.0);
      map.centerOn(pose.position());
      for (const double seconds : {0.0, 0.5, 1.0, 1.5}) {
        updateWith(map, scanTo({{4.3, 0.4}}, 2.0 * i + seconds), PointState::kUnknown, pose);
      }
    }
  };
  OccupancyMap in_memory{options};
  drive(in_memory);
  options.max_tiles = 3;
  options.tile_file.folder = testing::TempDir();
  OccupancyMap in_file{options};
  drive(in_file);
  EXPECT_EQ(in_file.forgottenTiles(), 0U) << in_file.tileFileError();
  const MapEvidence expected = in_memory.evidence();
  const MapEvidence evidence = in_file.evidence();
  ASSERT_EQ(evidence.cells.size(), expected.cells.size());
  for (std::size_t i = 0; i < evidence.cells.size(); ++i) {
    EXPECT_EQ(evidence.cells[i].cell, expected.cells[i].cell);
    EXPECT_EQ(evidence.cells[i].log_odds, expected.cells[i].log_odds);
    EXPECT_EQ(evidence.cells[i].hits.count, expected.cells[i].hits.count);
  }
  in_file.setWindow(in_file.extent());
  expectSurface(in_file);
}

TEST(MapEvidenceTest, ARestoredMapIsUpdated) {
  OccupancyMap map = OccupancyMap::restored(smallMap(), mapWithSurface().evidence());
  for (int i = 0; i < 60; ++i) {
    updateWith(map, scanTo({{8.5, 0.8}}, 0.1 * i));
  }
  EXPECT_EQ(map.stateOf({4, 0}), CellState::kFree) << "what stood there has gone";
  EXPECT_EQ(map.stateOf({8, 0}), CellState::kStatic);
}

TEST(MapEvidenceTest, AnEmptyMapHasNone) {
  const OccupancyMap map{smallMap()};
  EXPECT_TRUE(map.evidence().cells.empty());
  EXPECT_EQ(map.extent().columns, 1);
}

}  // namespace
}  // namespace datmo::map_evidence_test
