// SPDX-License-Identifier: BSD-3-Clause
// What a stereo camera's grid reports about invalid clouds, cameras and options.
#include <functional>
#include <limits>
#include <stdexcept>

#include "stereo_grids.h"
#include <gtest/gtest.h>

namespace datmo::stereo_grid_input_test {
namespace {

using namespace stereo_grids;

TEST(StereoGridInputTest, AnEmptyCloudIsUninformative) {
  MadeCloud made;
  const StereoGridResult result = StereoGridModel(StereoGridOptions()).grid(made.cloud());
  EXPECT_EQ(count(result.grid, kUnknownPercent), result.grid.cells().size());
  EXPECT_EQ(result.points, 0U);
  EXPECT_EQ(result.in_layer, 0U);
}

TEST(StereoGridInputTest, InvalidPointsChangeNothing) {
  MadeScene scene;
  scene.boxes = {wallAt(12.0, 5.0)};
  MadeCloud clean(scene);
  MadeCloud dirty(scene);
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double max = std::numeric_limits<float>::max();
  for (const double z : {nan, infinity, -infinity, -10.0, 0.0, max, -max, 1e-30}) {
    for (const double other : {nan, infinity, -infinity, max, -max, 0.0}) {
      dirty.add({0.0, other, z});
      dirty.add({other, 0.0, z});
    }
  }
  for (const double bad : {nan, infinity, -infinity, max, -max}) {
    dirty.add({bad, 0.0, 10.0});
    dirty.add({0.0, bad, 10.0});
  }
  for (const StereoGridMethod method : {StereoGridMethod::kColumns, StereoGridMethod::kCones}) {
    StereoGridOptions options = onFlatRoad();
    options.method = method;
    EXPECT_EQ(gridOf(clean, options).cells(), gridOf(dirty, options).cells());
  }
  // Also with the road estimated from them.
  EXPECT_TRUE(isOccupiedNear(gridOf(dirty), gridOf(dirty).window().cellAt({12.0, 0.0})));
}

TEST(StereoGridInputTest, FewLinesOfSightAreUninformative) {
  MadeScene scene;
  scene.step = 40;
  const SensorGrid grid = gridOf(scene, onFlatRoad());
  EXPECT_EQ(count(grid, kUnknownPercent), grid.cells().size());
}

TEST(StereoGridInputTest, IsolatedMismatchesAreNoObstacles) {
  MadeCloud made((MadeScene()));
  Random random(5);
  for (int i = 0; i < 900; ++i) {
    const double depth = random.uniform(3.0, 36.0);
    made.addAt({0.5 + depth, random.uniform(-0.5, 0.5) * depth, random.uniform(0.4, 1.3)});
  }
  EXPECT_EQ(count(gridOf(made), kOccupied), 0U);
}

TEST(StereoGridInputTest, PointsAreCounted) {
  MadeCloud made;
  made.addAt({10.0, 0.0, 0.0});  // on the road
  made.addAt({10.0, 1.0, 0.8});  // in the layer
  made.addAt({10.0, 1.0, 1.5});  // above it
  made.addAt({90.0, 1.0, 0.8});  // out of range
  made.addAt({-5.0, 1.0, 0.8});  // behind the camera
  const StereoGridResult result = StereoGridModel(onFlatRoad()).grid(made.cloud());
  EXPECT_EQ(result.points, 4U);
  EXPECT_EQ(result.in_layer, 1U);
}

TEST(StereoGridInputTest, ACameraThatMeasuresNothingIsRefused) {
  StereoGridModel model((StereoGridOptions()));
  MadeCloud made;
  const StereoCamera good = made.cloud().camera;
  const auto refused = [&](const std::function<void(StereoCamera&)>& spoil) {
    made.cloud().camera = good;
    spoil(made.cloud().camera);
    EXPECT_THROW(model.grid(made.cloud()), std::invalid_argument);
  };
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    refused([&](StereoCamera& camera) { camera.focal_length = bad; });
    refused([&](StereoCamera& camera) { camera.baseline = bad; });
    refused([&](StereoCamera& camera) { camera.noise.disparity_sigma = bad; });
    refused([&](StereoCamera& camera) { camera.noise.disparity_at_meter = bad; });
    refused([&](StereoCamera& camera) { camera.noise = DepthNoise::ofPolynomial(bad, 0.0, 0.0); });
  }
  refused([](StereoCamera& camera) { camera.focal_length = 0.0; });
  refused([](StereoCamera& camera) { camera.noise = DepthNoise(); });
  refused([](StereoCamera& camera) { camera.noise = DepthNoise::ofDisparity(400.0, 0.0, 0.25); });
  made.cloud().camera = good;
  made.cloud().camera.right_tangent = good.left_tangent;
  EXPECT_THROW(model.grid(made.cloud()), std::invalid_argument);
  made.cloud().camera = good;
  made.cloud().camera_in_base.translation().z() = -0.1;
  EXPECT_THROW(model.grid(made.cloud()), std::invalid_argument);
}

TEST(StereoGridInputTest, OptionsAreChecked) {
  EXPECT_THROW(readOptions<StereoGridOptions>({{"method", std::string("cubes")}}), OptionError);
  StereoGridOptions options;
  options.effective_range = -1.0;
  EXPECT_THROW(StereoGridModel{options}, OptionError);
}

}  // namespace
}  // namespace datmo::stereo_grid_input_test
