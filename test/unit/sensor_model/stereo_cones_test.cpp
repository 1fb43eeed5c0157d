// SPDX-License-Identifier: BSD-3-Clause
// The thesis's plain form, by hand-computed cells: eq. 3.2.2 to 3.2.4.

#include <algorithm>

#include "stereo_grids.h"
#include <gtest/gtest.h>

#include "datmo_fusion/sensor_model/stereo_grid.h"

namespace datmo::stereo_cones_test {
namespace {

using stereo_grids::count;
using stereo_grids::kFree;
using stereo_grids::kOccupied;

/// Cells of 1 m; 5 points in nine cells are noise.
StereoGridOptions cones() {
  StereoGridOptions options;
  options.method = StereoGridMethod::kCones;
  options.window.length = 80.0;
  options.window.width = 80.0;
  options.window.cell_size = 1.0;
  options.effective_range = 30.0;
  options.cones.threshold = 5;
  return options;
}

void addPoints(MadeCloud& made, const Eigen::Vector3d& position, int count) {
  for (int i = 0; i < count; ++i) {
    made.addAt(position);
  }
}

SensorGrid gridOf(MadeCloud& made) { return StereoGridModel(cones()).grid(made.cloud()).grid; }

TEST(StereoConesTest, WithoutObjectsTheWholeViewIsFree) {
  MadeCloud made;
  const SensorGrid grid = gridOf(made);
  EXPECT_EQ(grid.at({10, 0}), kFree);
  EXPECT_EQ(grid.at({29, 0}), kFree);
  EXPECT_EQ(grid.at({31, 0}), kUnknownPercent);  // out of range
  EXPECT_EQ(grid.at({10, 4}), kFree);            // tangent 4.5 / 10
  EXPECT_EQ(grid.at({10, 5}), kUnknownPercent);  // 5.5 / 10: out of view
  EXPECT_EQ(grid.at({-3, 0}), kUnknownPercent);
}

TEST(StereoConesTest, MorePointsThanTheThresholdInNineCellsAreOccupied) {
  MadeCloud made;
  addPoints(made, {15.5, 0.5, 0.8}, 6);
  const SensorGrid grid = gridOf(made);
  for (int column = 14; column <= 16; ++column) {
    for (int row = -1; row <= 1; ++row) {
      EXPECT_EQ(grid.at({column, row}), kOccupied) << column << ", " << row;
    }
  }
  EXPECT_EQ(count(grid, kOccupied), 9U);
}

TEST(StereoConesTest, AsManyPointsAsTheThresholdAreNoise) {
  MadeCloud made;
  addPoints(made, {15.5, 0.5, 0.8}, 5);
  EXPECT_EQ(gridOf(made).at({15, 0}), kFree);
}

TEST(StereoConesTest, TheConeOfAnObjectIsFreeBeforeAndUndecidedBehind) {
  MadeCloud made;
  addPoints(made, {15.5, 0.5, 0.8}, 6);
  const SensorGrid grid = gridOf(made);
  EXPECT_EQ(grid.at({13, 0}), kFree);
  EXPECT_EQ(grid.at({17, 0}), kUndecidedPercent);
  EXPECT_EQ(grid.at({28, 0}), kUndecidedPercent);
  // The cone opens from the camera, at 0.5 m, to the object's nearest cells, 14 m ahead.
  EXPECT_EQ(grid.at({28, 2}), kUndecidedPercent);  // tangent 2.5 / 28 of 1.5 / 14
  EXPECT_EQ(grid.at({28, 3}), kFree);              // 3.5 / 28
}

TEST(StereoConesTest, OnlyTheLayerCounts) {
  MadeCloud made;
  addPoints(made, {15.5, 0.5, 0.32}, 100);  // below the scanner's plane, 0.33 m
  addPoints(made, {15.5, 0.5, 1.34}, 100);  // 1 m above it
  EXPECT_EQ(gridOf(made).at({15, 0}), kFree);
  EXPECT_EQ(StereoGridModel(cones()).grid(made.cloud()).in_layer, 0U);
}

TEST(StereoConesTest, TheRoadIsTakenAsFlat) {
  MadeScene scene;
  scene.unknown_pitch = 0.03;
  MadeCloud made(scene);
  const StereoGridResult result = StereoGridModel(cones()).grid(made.cloud());
  EXPECT_FALSE(result.road_seen);
  EXPECT_EQ(result.road.slope_x, 0.0);
  EXPECT_GT(result.in_layer, 0U);
}

}  // namespace
}  // namespace datmo::stereo_cones_test
