// SPDX-License-Identifier: BSD-3-Clause
// Accuracy of positions from stereo and depth cameras.
#include <cmath>
#include <functional>

#include "made_road_users.h"
#include <gtest/gtest.h>

namespace datmo::camera_consistency_test {
namespace {

/// Mean of the squared error of the rear's position over its variance, and the mean error (m).
struct Consistency {
  double squares = 0.0;
  double bias = 0.0;
};

/// `shake`: adds errors shared by all points of a cloud to a scene, with this standard deviation in
/// units of a point's.
Consistency consistencyOf(MadeScene scene, double distance,
                          const StereoObjectDetectorOptions& options,
                          const std::function<void(MadeScene&, double)>& shake) {
  constexpr int kClouds = 24;
  Random random(5);
  Consistency mean;
  for (int i = 0; i < kClouds; ++i) {
    scene.seed = static_cast<std::uint64_t>(i) + 1;
    shake(scene, random.normal(options.noise.common));
    const std::vector<Object> objects = objectsIn(scene, options);
    EXPECT_EQ(objects.size(), 1U);
    if (objects.size() == 1) {
      const double error = -rearOf(objects[0]).position - distance;
      const double variance = objects[0].position_covariance(0, 0) + rearOf(objects[0]).variance;
      mean.squares += error * error / variance / kClouds;
      mean.bias += error / kClouds;
    }
  }
  return mean;
}

Consistency consistencyAt(double distance) {
  MadeScene scene = sceneOf({carAt(distance, 0.0)});
  scene.disparity_noise = 0.2;
  return consistencyOf(scene, distance, ofBoxes(), [](MadeScene& shaken, double sigmas) {
    shaken.disparity_bias = 0.25 * sigmas;
  });
}

TEST(StereoObjectDetector, KnowsTheUncertaintyOfAPosition) {
  const Consistency middle = consistencyAt(15.0);
  EXPECT_LT(middle.squares, 1.5);
  EXPECT_GT(middle.squares, 0.2);
  EXPECT_NEAR(middle.bias, 0.0, 0.15);
  const Consistency far = consistencyAt(25.0);
  EXPECT_LT(far.squares, 1.5);
  EXPECT_GT(far.squares, 0.2);
  EXPECT_NEAR(far.bias, 0.0, 0.4);
}

/// The room that a depth camera sees.
StereoObjectDetectorOptions ofARoom() {
  StereoObjectDetectorOptions options = ofBoxes();
  options.noise.body_sigma = 0.02;
  options.effective_range = 6.0;
  options.road.max_distance = 6.0;
  options.road.half_width = 3.0;
  options.road.min_cells = 5;
  return options;
}

TEST(StereoObjectDetector, DepthCamerasFindAPersonAndKnowHowWell) {
  const std::vector<DepthNoise> noises = {DepthNoise::ofPolynomial(0.0012, 0.0, 0.0019),
                                          DepthNoise::ofPolynomial(0.02, 0.001, 0.0),
                                          DepthNoise::ofPolynomial(0.1, 0.0, 0.0)};
  for (const DepthNoise& noise : noises) {
    MadeScene scene = sceneOf({pedestrianAt(4.0, 0.0)});
    scene.depth_noise = noise;
    const std::vector<Object> objects = objectsIn(scene, ofARoom());
    ASSERT_EQ(objects.size(), 1U) << noise.constant;
    EXPECT_EQ(objects[0].objectClass(), ObjectClass::kPedestrian) << noise.constant;
    const Consistency consistency =
        consistencyOf(scene, 4.0, ofARoom(),
                      [](MadeScene& shaken, double sigmas) { shaken.depth_bias = sigmas; });
    EXPECT_LT(consistency.squares, 1.5) << noise.constant;
    EXPECT_NEAR(consistency.bias, 0.0, 0.06) << noise.constant;
    // The covariance along the line of sight is that of the law: half of a standard deviation.
    const double expected = std::pow(0.5 * noise.sigma(3.5), 2.0) + 0.02 * 0.02;
    EXPECT_NEAR(objects[0].position_covariance(0, 0), expected, 0.1 * expected);
  }
}

TEST(StereoObjectDetector, WithoutBaselineNothingIsHiddenFromASecondCamera) {
  // The car ends 0.078 to the right of the axis (tangents), the person begins at 0.15; up to 0.5 m
  // (1 / 2.5 m - 1 / 11.5 m) = 0.157 to its left is hidden from the right camera.
  MadeScene scene = sceneOf({pedestrianAt(3.0, -0.625), carAt(12.0, 0.0)});
  const auto rightOfTheCar = [](const std::vector<Object>& objects) {
    const auto car = std::find_if(objects.begin(), objects.end(), [](const Object& object) {
      return object.objectClass() == ObjectClass::kVehicle;
    });
    return car == objects.end() ? -1.0 : rightOf(*car).variance;
  };
  MadeScene of_depth_camera = scene;
  of_depth_camera.depth_noise = DepthNoise::ofPolynomial(0.02, 0.001, 0.0);
  const double hidden = rightOfTheCar(objectsIn(scene, ofBoxes()));
  const double seen = rightOfTheCar(objectsIn(of_depth_camera, ofBoxes()));
  EXPECT_EQ(hidden, kHiddenSide);
  EXPECT_GT(seen, 0.0);
  EXPECT_LT(seen, 1.0);
}

}  // namespace
}  // namespace datmo::camera_consistency_test
