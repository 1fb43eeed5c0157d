// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/map/map_fuser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace datmo::map_fuser_test {
namespace {

constexpr Percent kOccupied = 80;  // log-odds ln 4
constexpr Percent kFree = 20;
constexpr double kTimeConstant = 60.0;  // s

/// A look at a free cell says as much as one at an occupied cell.
AgingMapOptions evenLooks() {
  AgingMapOptions options;
  options.free_probability = 0.2;
  return options;
}

/// 20 x 10 cells of 1 m about the vehicle.
const GridWindow kWindow{1.0, 20, 10, {-10, -5}};
const CellIndex kCell{3, 1};

Stamp at(double seconds) { return Stamp::fromSeconds(100.0 + seconds); }

SensorGrid gridWith(CellIndex cell, Percent percent, double seconds) {
  SensorGrid grid(at(seconds), kWindow);
  grid.at(cell) = percent;
  return grid;
}

PoseWithCovariance poseOf(const Pose2& pose, double sigma = 0.05, double heading_sigma = 0.0) {
  return {
      pose,
      Eigen::Vector3d(sigma * sigma, sigma * sigma, heading_sigma * heading_sigma).asDiagonal()};
}

TEST(AgingMap, EvidenceAddsUpToItsLimitAndAges) {
  AgingMap map(evenLooks(), 20, 10, 1.0);
  const double look = std::log(4.0);
  map.update(gridWith(kCell, kOccupied, 0.0), Pose2());
  EXPECT_NEAR(map.logOdds(kCell, at(0.0)), look, 1e-6);
  EXPECT_NEAR(map.logOdds(kCell, at(kTimeConstant)), look / std::exp(1.0), 1e-5);
  map.update(gridWith(kCell, kOccupied, kTimeConstant), Pose2());
  EXPECT_NEAR(map.logOdds(kCell, at(kTimeConstant)), look / std::exp(1.0) + look, 1e-5)
      << "it has aged before it is added to";
  for (int i = 1; i < 10; ++i) {
    map.update(gridWith(kCell, kOccupied, kTimeConstant + 0.1 * i), Pose2());
  }
  EXPECT_NEAR(map.logOdds(kCell, at(kTimeConstant + 0.9)), std::log(49.0), 1e-5);
  EXPECT_EQ(map.image(at(kTimeConstant + 0.9)).at(kCell), 98);
  EXPECT_EQ(map.image(at(10.0 * kTimeConstant)).at(kCell), kUnknownPercent);
  EXPECT_EQ(map.logOdds({4, 1}, at(0.0)), 0.0) << "never seen";
}

TEST(AgingMap, AGridIsSeenFromThePoseAndNoObstacleIsLost) {
  AgingMap map(evenLooks(), 40, 40, 1.0);
  const Pose2 base(2.0, 1.0, kPi / 4.0);
  SensorGrid grid(at(0.0), kWindow);
  std::fill(grid.cells().begin(), grid.cells().end(), kFree);
  grid.at(kCell) = kOccupied;
  map.update(grid, base);
  const CellIndex hit = map.window().cellAt(base * kWindow.centerOf(kCell));
  const SensorGrid image = map.image(at(0.0));
  EXPECT_EQ(image.at(hit), kOccupied);
  EXPECT_EQ(std::count(image.cells().begin(), image.cells().end(), kOccupied), 1);
}

TEST(AgingMap, WhatLeavesTheWindowIsForgotten) {
  AgingMap map(evenLooks(), 20, 10, 1.0);
  map.update(gridWith(kCell, kOccupied, 0.0), Pose2());
  map.centerOn({5.5, 0.5});
  EXPECT_EQ(map.image(at(0.0)).at(kCell), kOccupied);
  map.centerOn({50.5, 0.5});
  map.centerOn({0.5, 0.5});
  EXPECT_EQ(map.image(at(0.0)).at(kCell), kUnknownPercent);
}

class MapFuserTest : public testing::Test {
 protected:
  MapFuserTest() : MapFuserTest(MapFuserOptions()) {}
  explicit MapFuserTest(MapFuserOptions options) : options_(std::move(options)) {
    options_.map = evenLooks();
    options_.sources["lidar"].reliability = 1.0;
    options_.sources["stereo"].reliability = 1.0;
    fuser_ = MapFuser(options_);
    fuser_.moveTo(poseOf(Pose2()));
  }

  void take(const std::string& source, Percent percent, double seconds = 0.0) {
    fuser_.take(source, gridWith(kCell, percent, seconds), Pose2(), {});
  }

  void setPrior(CellIndex cell, double log_odds) {
    OccupancyMapOptions map;
    map.window = {20.0, 10.0, 1.0};
    MapEvidence evidence{1.0, {}};
    for (int row = -5; row < 5; ++row) {
      for (int column = -10; column < 10; ++column) {
        evidence.cells.push_back({{column, row}, -3.0F, 0.0F, 0, 0, {}});
      }
    }
    evidence.cells.push_back({cell, static_cast<float>(log_odds), 0.0F, 0, 0, {}});
    fuser_.setPrior(OccupancyMap::restored(map, evidence));
  }

  MapFuserOptions options_;
  MapFuser fuser_{options_};
};

TEST_F(MapFuserTest, TwoThatAgreeAreSurerThanOne) {
  take("lidar", kOccupied);
  EXPECT_EQ(fuser_.fuse(at(0.0))->fused.at(kCell), kOccupied);
  take("stereo", kOccupied);
  const auto maps = fuser_.fuse(at(0.0));
  EXPECT_EQ(maps->fused.at(kCell), 94) << "odds of 4 x 4 to 1";
  EXPECT_EQ(maps->conflict.at(kCell), 0);
  EXPECT_EQ(maps->conflict.at({4, 1}), kUnknownPercent);
  EXPECT_EQ(maps->cells_in_conflict, 0);
  EXPECT_FALSE(maps->changes);
}

TEST_F(MapFuserTest, TwoThatContradictAreAConflict) {
  take("lidar", kOccupied);
  take("stereo", kFree);
  const auto maps = fuser_.fuse(at(0.0));
  EXPECT_EQ(maps->fused.at(kCell), kUndecidedPercent);
  EXPECT_EQ(maps->conflict.at(kCell), 36) << "0.6 for each side";
  EXPECT_EQ(maps->cells_in_conflict, 1);
}

TEST_F(MapFuserTest, OneThatHasAgedSaysLess) {
  take("lidar", kOccupied, 0.0);
  take("stereo", kFree, kTimeConstant);
  const auto maps = fuser_.fuse(at(kTimeConstant));
  // ln 4 / e is 62 percent: odds of 62 / 38 / 4.
  EXPECT_EQ(maps->fused.at(kCell), 29);
  EXPECT_EQ(maps->conflict.at(kCell), 14);
  EXPECT_EQ(maps->cells_in_conflict, 0);
}

TEST_F(MapFuserTest, ReliabilityBoundsWhatASourceSaysHoweverOftenItLooks) {
  options_.sources["lidar"].reliability = 0.5;
  fuser_ = MapFuser(options_);
  for (int i = 0; i < 20; ++i) {
    take("lidar", kOccupied, 0.1 * i);
  }
  take("stereo", kFree, 2.0);
  take("stereo", kFree, 2.1);
  // 98 percent, half believed, are 74 percent; against odds of 16 to 1 (94 percent).
  EXPECT_NEAR(fuser_.fuse(at(2.1))->fused.at(kCell), 15, 1);
}

TEST_F(MapFuserTest, WithoutReliabilityItIsNoSource) {
  options_.sources["stereo"].reliability = 0.0;
  fuser_ = MapFuser(options_);
  EXPECT_EQ(options_.sourcesInUse(), std::vector<std::string>{"lidar"});
  EXPECT_THROW(take("stereo", kOccupied), std::out_of_range);
  EXPECT_FALSE(fuser_.fuse(at(0.0))) << "no map yet";
}

TEST_F(MapFuserTest, WhatMovesIsNotInTheMaps) {
  const Point2 mover = kWindow.centerOf(kCell) + Point2(0.6, 0.0);
  fuser_.take("lidar", gridWith(kCell, kOccupied, 0.0), Pose2(), {mover});
  EXPECT_EQ(fuser_.fuse(at(0.0))->fused.at(kCell), kUnknownPercent);
  fuser_.take("lidar", gridWith(kCell, kFree, 0.1), Pose2(), {mover});
  EXPECT_EQ(fuser_.fuse(at(0.1))->fused.at(kCell), kFree);
}

TEST_F(MapFuserTest, TheMapsMoveWithTheVehicle) {
  take("lidar", kOccupied);
  fuser_.moveTo(poseOf(Pose2(8.0, 0.0, 0.0)));
  const auto maps = fuser_.fuse(at(0.0));
  EXPECT_EQ(maps->fused.window().corner, (CellIndex{-2, -5}));
  EXPECT_EQ(maps->fused.at(kCell), kOccupied);
  fuser_.take("stereo", gridWith(kCell, kOccupied, 0.1), Pose2(8.0, 0.0, 0.0), {});
  EXPECT_EQ(fuser_.fuse(at(0.1))->fused.at({11, 1}), kOccupied) << "seen from there";
  fuser_.take("stereo", gridWith({-5, 1}, kOccupied, 0.2), Pose2(8.0, 0.0, 0.0), {});
  EXPECT_EQ(fuser_.fuse(at(0.2))->fused.at(kCell), 94);
}

TEST_F(MapFuserTest, AfterAGapTheMapsBeginAnew) {
  take("lidar", kOccupied);
  fuser_.moveTo(poseOf(Pose2(), 0.4));
  EXPECT_EQ(fuser_.mapsBegun(), 0);
  fuser_.moveTo(poseOf(Pose2(), 2.0));
  EXPECT_EQ(fuser_.mapsBegun(), 1);
  EXPECT_FALSE(fuser_.fuse(at(0.0)));
  take("lidar", kFree, 1.0);
  fuser_.moveTo(poseOf(Pose2(), 0.1));
  EXPECT_EQ(fuser_.mapsBegun(), 2) << "found again: elsewhere";
}

TEST_F(MapFuserTest, APriorMapIsOneMoreSource) {
  options_.prior_reliability = 1.0;
  fuser_ = MapFuser(options_);
  fuser_.moveTo(poseOf(Pose2()));
  setPrior(kCell, std::log(4.0));
  take("lidar", kOccupied);
  const auto maps = fuser_.fuse(at(0.0));
  EXPECT_EQ(maps->fused.at(kCell), 94);
  EXPECT_LT(maps->fused.at({0, 0}), 10) << "known to the prior map alone";
  ASSERT_TRUE(maps->changes);
  EXPECT_EQ(maps->changes->appeared + maps->changes->vanished, 0);
}

TEST_F(MapFuserTest, WhileThePoseIsUncertainThePriorMapIsLeftOut) {
  fuser_.moveTo(poseOf(Pose2(), 1.0));
  setPrior(kCell, 3.0);
  take("lidar", kFree);
  const auto maps = fuser_.fuse(at(0.0));
  EXPECT_FALSE(maps->changes);
  EXPECT_EQ(maps->fused.at(kCell), kFree);
  EXPECT_EQ(maps->fused.at({0, 0}), kUnknownPercent);
}

SensorGrid freeBut(CellIndex cell) {
  SensorGrid grid(at(0.0), kWindow);
  std::fill(grid.cells().begin(), grid.cells().end(), Percent{10});
  grid.at(cell) = 90;
  return grid;
}

TEST(MapChanges, WhatIsElsewhereIsNewThereAndVanishedHere) {
  const auto changes = changesBetween(freeBut({0, 0}), freeBut({3, 0}), poseOf(Pose2(), 0.0), {});
  EXPECT_EQ(changes.appeared, 1);
  EXPECT_EQ(changes.vanished, 1);
  EXPECT_EQ(changes.grid.at({3, 0}), kNewPercent);
  EXPECT_EQ(changes.grid.at({0, 0}), kVanishedPercent);
  EXPECT_EQ(changes.grid.at({1, 0}), kUnknownPercent);
}

TEST(MapChanges, ASurfaceThatMovedByACellIsNoChange) {
  for (const CellIndex moved : {CellIndex{1, 0}, CellIndex{0, -1}, CellIndex{1, 1}}) {
    const auto changes = changesBetween(freeBut({0, 0}), freeBut(moved), poseOf(Pose2(), 0.0), {});
    EXPECT_EQ(changes.appeared + changes.vanished, 0);
  }
}

TEST(MapChanges, AnUncertainPoseExplainsMore) {
  const auto changed = [](CellIndex moved, const PoseWithCovariance& pose) {
    return changesBetween(freeBut({0, 0}), freeBut(moved), pose, {}).appeared;
  };
  EXPECT_EQ(changed({3, 0}, poseOf(Pose2(), 0.5)), 1) << "1.5 m and 2 x 0.5 m are less than 3 m";
  EXPECT_EQ(changed({3, 0}, poseOf(Pose2(), 0.8)), 0);
  EXPECT_EQ(changed({3, 0}, poseOf(Pose2(3.5, 0.5, 0.0), 0.0, 0.2)), 1) << "at the vehicle";
  EXPECT_EQ(changed({3, 0}, poseOf(Pose2(-6.5, 0.5, 0.0), 0.0, 0.2)), 0) << "10 m away";
}

TEST(MapChanges, WhatOneMapDoesNotKnowHasNotChanged) {
  SensorGrid unknown(at(0.0), kWindow);
  const SensorGrid known = freeBut({0, 0});
  for (const auto& [before, now] : {std::pair(unknown, known), std::pair(known, unknown)}) {
    const auto changes = changesBetween(before, now, poseOf(Pose2()), {});
    EXPECT_EQ(changes.appeared + changes.vanished, 0);
  }
  SensorGrid unsure = known;
  unsure.at({0, 0}) = 30;
  EXPECT_EQ(changesBetween(known, unsure, poseOf(Pose2()), {}).vanished, 0);
  EXPECT_THROW(changesBetween(known, SensorGrid(at(0.0), {1.0, 2, 2, {}}), poseOf(Pose2()), {}),
               std::invalid_argument);
}

}  // namespace
}  // namespace datmo::map_fuser_test
