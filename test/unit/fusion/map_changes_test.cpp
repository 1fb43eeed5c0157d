// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/map/map_changes.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "map_samples.h"
#include <gtest/gtest.h>

namespace datmo::map_changes_test {
namespace {

using namespace map_samples;

SensorGrid freeBut(CellIndex cell) {
  SensorGrid grid(stampAt(0.0), kWindow);
  std::fill(grid.cells().begin(), grid.cells().end(), Percent{10});
  grid.at(cell) = 90;
  return grid;
}

TEST(MapChanges, AMovedObjectIsNewThereAndVanishedHere) {
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

TEST(MapChanges, CellsUnknownToOneMapHaveNotChanged) {
  SensorGrid unknown(stampAt(0.0), kWindow);
  const SensorGrid known = freeBut({0, 0});
  for (const auto& [before, now] : {std::pair(unknown, known), std::pair(known, unknown)}) {
    const auto changes = changesBetween(before, now, poseOf(Pose2()), {});
    EXPECT_EQ(changes.appeared + changes.vanished, 0);
  }
  SensorGrid unsure = known;
  unsure.at({0, 0}) = 30;
  EXPECT_EQ(changesBetween(known, unsure, poseOf(Pose2()), {}).vanished, 0);
  EXPECT_THROW(
      changesBetween(known, SensorGrid(stampAt(0.0), {1.0, 2, 2, {}}), poseOf(Pose2()), {}),
      std::invalid_argument);
}

}  // namespace
}  // namespace datmo::map_changes_test
