// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/stereo_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "stereo_grids.h"
#include <gtest/gtest.h>

namespace datmo::stereo_grid_test {
namespace {

using namespace stereo_grids;

/// Share of the occupied cells of one grid that another one has within one cell.
double shareFoundIn(const SensorGrid& other, const SensorGrid& grid) {
  int occupied = 0;
  int found = 0;
  grid.forEach([&](CellIndex cell, Percent percent) {
    occupied += isOccupied(percent) ? 1 : 0;
    found += isOccupied(percent) && isOccupiedNear(other, cell) ? 1 : 0;
  });
  return static_cast<double>(found) / occupied;
}

TEST(StereoGridTest, AWallIsOccupiedAndFreeBeforeAndUnknownBehind) {
  MadeScene scene;
  scene.boxes = {wallAt(10.0, 6.0)};
  const SensorGrid grid = gridOf(scene);
  EXPECT_EQ(grid.stamp(), Stamp::fromSeconds(7.0));
  for (const double y : {-2.2, -0.7, 0.2, 1.4, 2.3}) {
    EXPECT_TRUE(isOccupiedNear(grid, grid.window().cellAt({10.0, y}))) << "y = " << y;
    for (const double x : {6.0, 7.0, 8.0, 9.0}) {
      EXPECT_EQ(at(grid, x, y), kFree) << "x = " << x << ", y = " << y;
    }
    for (const double x : {11.0, 12.0, 20.0, 30.0}) {
      EXPECT_EQ(at(grid, x, y), kUnknownPercent) << "x = " << x << ", y = " << y;
    }
  }
}

TEST(StereoGridTest, TheOpenRoadIsFreeInViewAndTheRestIsUnknown) {
  const SensorGrid grid = gridOf(MadeScene());
  EXPECT_EQ(count(grid, kOccupied), 0U);
  for (const double x : {6.0, 10.0, 20.0, 30.0, 36.0}) {
    for (const double tangent : {-0.45, 0.0, 0.45}) {
      const bool in_range = (x - 0.5) * std::hypot(1.0, tangent) < 36.0;
      EXPECT_EQ(at(grid, x, tangent * (x - 0.5)), in_range ? kFree : kUnknownPercent)
          << "x = " << x << ", tangent = " << tangent;
    }
    EXPECT_EQ(at(grid, x, 0.55 * x), kUnknownPercent);
  }
  EXPECT_EQ(at(grid, 37.0, 0.0), kUnknownPercent);
  EXPECT_EQ(at(grid, -10.0, 0.0), kUnknownPercent);
  // The image begins 4 m ahead; lines of sight are too high before that.
  EXPECT_EQ(at(grid, 2.0, 0.0), kUnknownPercent);
}

TEST(StereoGridTest, NoiseOfTheDepthSmearsAWallByLessThanItDoesThePoints) {
  MadeScene scene;
  scene.boxes = {wallAt(25.0, 8.0)};
  scene.disparity_noise = 0.25;
  MadeCloud made(scene);
  const SensorGrid grid = gridOf(made);
  const double sigma = made.cloud().camera.depthSigma(24.5);
  int occupied = 0;
  int near = 0;
  grid.forEach([&](CellIndex cell, Percent percent) {
    if (isOccupied(percent)) {
      const double offset = std::abs(grid.window().centerOf(cell).x() - 25.0);
      ++occupied;
      near += offset < sigma ? 1 : 0;
      EXPECT_LT(offset, 2.5 * sigma);
    }
  });
  EXPECT_GE(near, 8.0 / 0.3);  // one for each cell of the wall's width
  EXPECT_GE(near, 0.9 * occupied);
}

TEST(StereoGridTest, CellsThatMayHoldAnObstacleAreNotFree) {
  MadeScene scene;
  scene.boxes = {wallAt(25.0, 8.0)};
  scene.disparity_noise = 0.25;
  MadeCloud made(scene);
  const SensorGrid grid = gridOf(made);
  const double margin = 1.5 * made.cloud().camera.depthSigma(24.5);
  for (double x = 25.0 - 0.8 * margin; x < 26.0; x += 0.3) {
    EXPECT_NE(at(grid, x, 0.0), kFree) << "x = " << x;
  }
  EXPECT_EQ(at(grid, 22.0, 0.0), kFree);
}

TEST(StereoGridTest, ALongHoleInTheTextureOfTheRoadIsNotFree) {
  MadeScene scene;
  scene.hole = MadeHole{9.0, 20.0};
  const SensorGrid grid = gridOf(scene);
  EXPECT_EQ(at(grid, 7.0, 0.0), kFree);
  for (const double x : {10.0, 11.5, 13.0, 14.5}) {
    EXPECT_EQ(at(grid, x, 0.0), kUnknownPercent) << "x = " << x;
  }
  EXPECT_EQ(at(grid, 21.0, 0.0), kFree);
}

/// One row of a level image: points 20 m ahead, `down` m below the camera.
MadeCloud rowOfPoints(double down) {
  constexpr double kDepth = 20.0;
  constexpr int kHalfWidth = 200;  // px, of the made camera, whose tangents are -0.5 to 0.5
  MadeCloud row;
  for (int column = -kHalfWidth; column < kHalfWidth; ++column) {
    row.add({(column + 0.5) / (2.0 * kHalfWidth) * kDepth, down, kDepth});
  }
  return row;
}

TEST(StereoGridTest, AHorizontalLineOfSightDoesNotSeeTheGround) {
  const double camera_height = MadeScene().camera_height;
  MadeCloud on_road = rowOfPoints(camera_height);
  EXPECT_EQ(at(gridOf(on_road, onFlatRoad()), 18.5, 0.0), kFree) << "below the layer from 15 m on";
  MadeCloud level = rowOfPoints(0.0);
  const StereoGridResult result = StereoGridModel(onFlatRoad()).grid(level.cloud());
  EXPECT_GT(result.in_layer, 0U);
  EXPECT_EQ(count(result.grid, kFree), 0U) << "always as high as the camera";
}

TEST(StereoGridTest, AThinPoleIsFoundAndCellsBesideItStayFree) {
  MadeScene scene;
  scene.boxes = {{{15.0, 1.0, 0.0}, {15.1, 1.1, 2.0}}};
  scene.disparity_noise = 0.25;
  const SensorGrid grid = gridOf(scene);
  EXPECT_TRUE(isOccupiedNear(grid, grid.window().cellAt({15.05, 1.05})));
  EXPECT_LE(count(grid, kOccupied), 6U);
  EXPECT_EQ(at(grid, 15.0, 2.0), kFree);
  EXPECT_EQ(at(grid, 15.0, 0.0), kFree);
}

TEST(StereoGridTest, ObjectsBelowTheScannerAreNoObstacles) {
  MadeScene scene;
  scene.boxes = {{{10.0, -3.0, 0.0}, {14.0, 3.0, 0.15}}};
  scene.disparity_noise = 0.25;
  const SensorGrid grid = gridOf(scene);
  EXPECT_EQ(count(grid, kOccupied), 0U);
  EXPECT_EQ(at(grid, 12.0, 0.0), kFree);
}

TEST(StereoGridTest, OverhangingObjectsAreNoObstacles) {
  MadeScene scene;
  scene.boxes = {{{12.0, -3.0, 1.5}, {12.5, 3.0, 3.0}}};
  EXPECT_EQ(count(gridOf(scene), kOccupied), 0U);
}

TEST(StereoGridTest, AnUnknownPitchIsSeenInTheRoad) {
  MadeScene scene;
  scene.unknown_pitch = 0.03;
  scene.disparity_noise = 0.1;
  MadeCloud made(scene);
  StereoGridModel model((StereoGridOptions()));
  const StereoGridResult result = model.grid(made.cloud());
  EXPECT_TRUE(result.road_seen);
  EXPECT_NEAR(result.road.slope_x, 0.03, 0.003);
  EXPECT_EQ(count(result.grid, kOccupied), 0U);
  EXPECT_EQ(at(result.grid, 15.0, 0.0), kFree);
  EXPECT_GT(count(gridOf(made, onFlatRoad()), kOccupied), 100U);
}

TEST(StereoGridTest, TheLastRoadIsKeptUntilReset) {
  MadeScene scene;
  scene.unknown_pitch = 0.03;
  MadeCloud road(scene);
  MadeCloud nothing;
  StereoGridModel model((StereoGridOptions()));
  EXPECT_FALSE(model.grid(nothing.cloud()).road_seen);
  EXPECT_TRUE(model.grid(road.cloud()).road_seen);
  const StereoGridResult later = model.grid(nothing.cloud());
  EXPECT_FALSE(later.road_seen);
  EXPECT_NEAR(later.road.slope_x, 0.03, 0.003);
  model.reset();
  EXPECT_EQ(model.grid(nothing.cloud()).road.slope_x, 0.0);
}

TEST(StereoGridTest, ACameraMayFaceSideways) {
  MadeScene scene;
  scene.camera_yaw = 1.2;
  scene.boxes = {{{2.0, 9.0, 0.0}, {6.0, 9.5, 2.0}}};
  const SensorGrid grid = gridOf(scene);
  EXPECT_TRUE(isOccupiedNear(grid, grid.window().cellAt({4.0, 9.0})));
  EXPECT_EQ(at(grid, 3.0, 7.0), kFree);
  EXPECT_EQ(at(grid, 10.0, 0.0), kUnknownPercent);
}

TEST(StereoGridTest, AThinnedCloudGivesTheSameObstaclesAndTheSameFreeRoad) {
  MadeScene scene;
  scene.boxes = {wallAt(9.0, 3.0), {{14.0, 3.0, 0.0}, {18.0, 4.6, 1.5}}};
  scene.disparity_noise = 0.1;
  const SensorGrid dense = gridOf(scene);
  for (const int step : {2, 3}) {
    scene.step = step;
    const SensorGrid thinned = gridOf(scene);
    EXPECT_GE(shareFoundIn(thinned, dense), 0.9) << "every " << step;
    EXPECT_GE(shareFoundIn(dense, thinned), 0.9) << "every " << step;
    for (double x = 6.0; x < 16.0; x += 0.3) {
      EXPECT_EQ(at(thinned, x, -3.0), at(dense, x, -3.0)) << "every " << step << ", x = " << x;
    }
  }
}

TEST(StereoGridTest, TheSameCloudsGiveTheSameGrids) {
  MadeScene scene;
  scene.boxes = {wallAt(17.0, 5.0)};
  scene.disparity_noise = 0.3;
  scene.unknown_pitch = 0.01;
  MadeCloud made(scene);
  StereoGridModel one((StereoGridOptions()));
  StereoGridModel other((StereoGridOptions()));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(one.grid(made.cloud()).grid.cells(), other.grid(made.cloud()).grid.cells());
  }
}

}  // namespace
}  // namespace datmo::stereo_grid_test
