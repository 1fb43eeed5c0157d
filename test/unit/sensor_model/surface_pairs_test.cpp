// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/surface_pairs.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "made_stereo.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::surface_pairs_test {
namespace {

constexpr double kWall = 12.0;  // m, of the object ahead

/// The end of a wall across the road.
MadeScene wallAhead(double from_y = -3.0, double to_y = 3.0) {
  MadeScene scene;
  scene.boxes = {{{kWall, from_y, 0.0}, {kWall + 1.0, to_y, 2.0}}};
  return scene;
}

/// A scanner at the bumper that sees an object at `x`, between two y.
std::vector<Ray> scanOf(double x, double from_y, double to_y, double spacing = degrees(0.5)) {
  std::vector<Ray> rays;
  for (int beam = 0; beam < 360; ++beam) {
    const double bearing = (beam - 180) * spacing;
    Ray ray;
    ray.origin = Point2(1.0, 0.0);
    ray.beam = static_cast<std::uint32_t>(beam);
    ray.bearing = bearing;
    const double y = (x - 1.0) * std::tan(bearing);
    ray.hit = std::abs(bearing) < degrees(60.0) && y > from_y && y < to_y;
    ray.end = Point2(x, y);
    ray.range = (ray.end - ray.origin).norm();
    rays.push_back(ray);
  }
  return rays;
}

std::vector<SurfacePair> pairsOf(const MadeScene& scene, const std::vector<Ray>& rays) {
  MadeCloud made(scene);
  SurfacePairFinder finder{SurfacePairOptions()};
  return finder.find(made.cloud(), rays, StereoAlignment(), {});
}

TEST(SurfacePairs, AWallHasTheBiasOfTheCamera) {
  MadeScene scene = wallAhead();
  scene.disparity_bias = 0.5;
  scene.disparity_noise = 0.2;
  const std::vector<SurfacePair> pairs = pairsOf(scene, scanOf(kWall, -3.0, 3.0));
  ASSERT_GE(pairs.size(), 2U);
  for (const SurfacePair& pair : pairs) {
    EXPECT_NEAR(pair.difference, 0.5, 0.05);
    EXPECT_NEAR(pair.inverseDepth(), 1.0 / (kWall - 0.5), 1e-3) << "from the camera at 0.5 m";
    EXPECT_NEAR(pair.slope, 0.0, 1e-3);
    EXPECT_LT(std::abs(pair.tangent), 0.3);
  }
}

TEST(SurfacePairs, WithoutABiasThereIsNone) {
  for (const SurfacePair& pair : pairsOf(wallAhead(), scanOf(kWall, -3.0, 3.0))) {
    EXPECT_NEAR(pair.difference, 0.0, 0.02);
  }
}

/// Half of what the camera sees there is behind what the scanner sees.
TEST(SurfacePairs, TheSeamOfTheBearingsIsNoStep) {
  // Two surfaces, 3 m apart, whose edge is where the bearings of a scanner that looks back wrap.
  MadeScene scene;
  scene.boxes = {{{kWall, 0.0, 0.0}, {kWall + 1.0, 3.0, 2.0}},
                 {{kWall - 3.0, -3.0, 0.0}, {kWall - 2.0, 0.0, 2.0}}};
  std::vector<Ray> rays = scanOf(kWall, 0.0, 3.0);
  const std::vector<Ray> nearer = scanOf(kWall - 3.0, -3.0, 0.0);
  std::copy(nearer.begin(), nearer.begin() + 180, rays.begin());
  const std::size_t pairs = pairsOf(scene, rays).size();
  ASSERT_GE(pairs, 2U);
  for (Ray& ray : rays) {
    ray.bearing = normalizeAngle(ray.bearing + kPi);
  }
  EXPECT_EQ(pairsOf(scene, rays).size(), pairs);
}

TEST(SurfacePairs, ColumnsOfTwoSurfacesMakeNone) {
  MadeScene scene = wallAhead();
  scene.boxes[0].max.z() = 0.7;
  scene.boxes.push_back({{20.0, -6.0, 0.0}, {21.0, 6.0, 3.0}});
  EXPECT_TRUE(pairsOf(scene, scanOf(kWall, -3.0, 3.0)).empty());
}

/// Through a gap the scanner sees what is hidden from the camera, and vice versa.
TEST(SurfacePairs, SurfacesHiddenFromOneMakeNone) {
  EXPECT_TRUE(pairsOf(wallAhead(), scanOf(5.0, -1.5, 1.5)).empty()) << "nothing there for one";
  EXPECT_TRUE(pairsOf(wallAhead(1.0, 3.0), scanOf(kWall, -3.0, 0.5)).empty());
}

TEST(SurfacePairs, FewBeamsAndSlantedSurfacesMakeNone) {
  EXPECT_TRUE(pairsOf(wallAhead(-0.3, 0.3), scanOf(kWall, -0.1, 0.1)).empty());
  MadeScene side;
  side.boxes = {{{5.0, 2.0, 0.0}, {25.0, 3.0, 2.0}}};
  std::vector<Ray> rays;
  for (int beam = 0; beam < 40; ++beam) {
    Ray ray;
    ray.origin = Point2(1.0, 0.0);
    ray.bearing = degrees(6.0 + 0.5 * beam);
    ray.end = Point2(1.0 + 2.0 / std::tan(ray.bearing), 2.0);
    ray.range = (ray.end - ray.origin).norm();
    ray.beam = static_cast<std::uint32_t>(beam);
    ray.hit = true;
    rays.push_back(ray);
  }
  EXPECT_TRUE(pairsOf(side, rays).empty()) << "60 degrees and more from the normal";
}

TEST(SurfacePairs, InvalidOptionsAreRefused) {
  SurfacePairOptions options;
  options.min_beams = 1;
  EXPECT_THROW(SurfacePairFinder{options}, OptionError);
}

}  // namespace
}  // namespace datmo::surface_pairs_test
