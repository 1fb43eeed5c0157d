// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/road_plane.h"

#include <limits>

#include "made_stereo.h"
#include <gtest/gtest.h>

namespace datmo::road_plane_test {
namespace {

std::optional<RoadPlane> planeOf(const MadeScene& scene) {
  MadeCloud made(scene);
  return RoadPlaneEstimator(RoadPlaneOptions()).update(made.cloud());
}

TEST(RoadPlaneTest, HeightsAreAboveThePlane) {
  const RoadPlane plane{0.1, 0.02, -0.01};
  EXPECT_DOUBLE_EQ(plane.heightOf({10.0, 5.0, 1.0}), 1.0 - (0.1 + 0.2 - 0.05));
  EXPECT_DOUBLE_EQ(RoadPlane().heightOf({10.0, 5.0, 1.0}), 1.0);
}

TEST(RoadPlaneTest, AFlatRoadIsFlat) {
  const auto plane = planeOf(MadeScene());
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->height, 0.0, 0.005);
  EXPECT_NEAR(plane->slope_x, 0.0, 0.0005);
  EXPECT_NEAR(plane->slope_y, 0.0, 0.0005);
}

TEST(RoadPlaneTest, APitchIsFoundInBothDirectionsAndWithNoise) {
  for (const double pitch : {-0.03, -0.01, 0.01, 0.03}) {
    MadeScene scene;
    scene.unknown_pitch = pitch;
    scene.disparity_noise = 0.25;
    const auto plane = planeOf(scene);
    ASSERT_TRUE(plane) << pitch;
    EXPECT_NEAR(plane->slope_x, pitch, 0.004);
    EXPECT_NEAR(plane->heightOf({20.5, 0.0, 20.0 * pitch}), 0.0, 0.08);
  }
}

TEST(RoadPlaneTest, ObjectsBesideTheRoadDoNotTiltIt) {
  MadeScene scene;
  scene.boxes = {{{6.0, 2.5, 0.0}, {30.0, 4.5, 1.5}}, {{10.0, -6.0, 0.0}, {14.0, -3.0, 0.15}}};
  const auto plane = planeOf(scene);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->slope_y, 0.0, 0.005);
  EXPECT_NEAR(plane->heightOf({15.0, 0.0, 0.0}), 0.0, 0.02);
}

TEST(RoadPlaneTest, NoRoadIsSeenInAWall) {
  MadeScene scene;
  scene.boxes = {wallAt(3.0, 20.0)};
  EXPECT_FALSE(planeOf(scene));
}

TEST(RoadPlaneTest, AnIncredibleSlopeIsNoRoad) {
  MadeScene scene;
  scene.unknown_pitch = 0.2;
  EXPECT_FALSE(planeOf(scene));
  RoadPlaneOptions options;
  options.max_slope = 0.01;
  scene.unknown_pitch = 0.02;
  MadeCloud made(scene);
  EXPECT_FALSE(RoadPlaneEstimator(options).update(made.cloud()));
}

TEST(RoadPlaneTest, SlopesInBothDirectionsAreOneSlope) {
  MadeScene scene;
  scene.camera_yaw = 0.25 * kPi;
  scene.unknown_pitch = 0.03;  // 0.021 along either axis of the vehicle
  RoadPlaneOptions options;
  options.max_slope = 0.025;
  MadeCloud made(scene);
  EXPECT_FALSE(RoadPlaneEstimator(options).update(made.cloud()));
  options.max_slope = 0.035;
  EXPECT_TRUE(RoadPlaneEstimator(options).update(made.cloud()));
}

TEST(RoadPlaneTest, TheLastPlaneInitializesTheNextOne) {
  // 60 mm per meter in one step is too far from flat; in two steps it is not.
  RoadPlaneEstimator estimator((RoadPlaneOptions()));
  for (const double pitch : {0.03, 0.06}) {
    MadeScene scene;
    scene.unknown_pitch = pitch;
    MadeCloud made(scene);
    ASSERT_TRUE(estimator.update(made.cloud())) << pitch;
    EXPECT_NEAR(estimator.last().slope_x, std::tan(pitch), 0.004);
  }
  MadeCloud empty;
  EXPECT_FALSE(estimator.update(empty.cloud()));
  EXPECT_NEAR(estimator.last().slope_x, 0.06, 0.004);
  estimator.reset();
  EXPECT_EQ(estimator.last().slope_x, 0.0);
}

TEST(RoadPlaneTest, SwitchedOffNothingIsEstimated) {
  RoadPlaneOptions options;
  options.estimate = false;
  MadeScene scene;
  scene.unknown_pitch = 0.02;
  MadeCloud made(scene);
  RoadPlaneEstimator estimator(options);
  EXPECT_FALSE(estimator.update(made.cloud()));
  EXPECT_EQ(estimator.last().slope_x, 0.0);
}

}  // namespace
}  // namespace datmo::road_plane_test
