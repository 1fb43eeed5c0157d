// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "stereo_grids.h"
#include <gtest/gtest.h>

#include "datmo_fusion/sensor_model/stereo_grid.h"

namespace datmo::depth_camera_grid_test {
namespace {

using stereo_grids::at;

/// m; the floor is visible from 2 m on.
constexpr double kLow = 0.6;

/// A room as a depth camera sees it: 6 m long, in cells of 0.1 m.
StereoGridOptions inARoom() {
  StereoGridOptions options;
  options.window.length = 16.0;
  options.window.width = 16.0;
  options.window.cell_size = 0.1;
  options.effective_range = 6.0;
  options.road.max_distance = 6.0;
  options.road.half_width = 3.0;
  options.road.min_cells = 5;
  return options;
}

MadeScene ofDepthCamera(DepthPrinciple principle) {
  DepthNoiseOptions options;
  options.principle = principle;
  MadeScene scene;
  scene.camera_height = kLow;
  scene.depth_noise = depthNoise(options, 400.0, 0.075);
  return scene;
}

TEST(DepthCameraGrid, DepthCamerasSeeAWallWhereItIs) {
  for (const DepthPrinciple principle :
       {DepthPrinciple::kStructuredLight, DepthPrinciple::kTimeOfFlight}) {
    MadeScene scene = ofDepthCamera(principle);
    scene.boxes = {wallAt(5.0, 3.0)};
    MadeCloud made(scene);
    const StereoGridResult result = StereoGridModel(inARoom()).grid(made.cloud());
    EXPECT_TRUE(result.road_seen) << static_cast<int>(principle);
    EXPECT_NEAR(result.road.height, 0.0, 0.02) << static_cast<int>(principle);
    std::size_t on_wall = 0;
    std::size_t elsewhere = 0;
    result.grid.forEach([&](CellIndex cell, Percent percent) {
      const Point2 position = result.grid.window().centerOf(cell);
      if (isOccupied(percent)) {
        // One cell to either side: the wall is on the border of two, and its noise below a cell.
        ++(std::abs(position.x() - 5.0) < 0.2 && std::abs(position.y()) < 1.6 ? on_wall
                                                                              : elsewhere);
      }
    });
    EXPECT_GE(on_wall, 28U) << static_cast<int>(principle);
    EXPECT_EQ(elsewhere, 0U) << static_cast<int>(principle);
    EXPECT_EQ(at(result.grid, 4.2, 0.0), 20) << static_cast<int>(principle);
    EXPECT_EQ(at(result.grid, 5.5, 0.0), kUnknownPercent) << static_cast<int>(principle);
  }
}

/// Distance ahead of the vehicle, m, up to which cells are free in front of a wall at 5 m.
double freeUpToAWall(const DepthNoise& noise) {
  MadeScene scene;
  scene.camera_height = kLow;
  scene.depth_noise = noise;
  scene.boxes = {wallAt(5.0, 3.0)};
  MadeCloud made(scene);
  const SensorGrid grid = StereoGridModel(inARoom()).grid(made.cloud()).grid;
  double x = 3.5;
  while (isFree(at(grid, x + 0.05, 0.05))) {
    x += 0.1;
  }
  return x;
}

TEST(DepthCameraGrid, FreeEndsWhereTheLawOfNoiseSays) {
  // 1.5 standard deviations before the wall and a cell.
  const double sharp = freeUpToAWall(DepthNoise::ofPolynomial(0.005, 0.0, 0.0));
  const double constant = freeUpToAWall(DepthNoise::ofPolynomial(0.2, 0.0, 0.0));
  const double linear = freeUpToAWall(DepthNoise::ofPolynomial(0.0001, 0.0444, 0.0));
  EXPECT_GT(sharp, 4.7);
  EXPECT_LT(constant, 4.65);
  EXPECT_NEAR(constant, linear, 0.25) << "0.2 m at 4.5 m ahead of the camera";
}

}  // namespace
}  // namespace datmo::depth_camera_grid_test
