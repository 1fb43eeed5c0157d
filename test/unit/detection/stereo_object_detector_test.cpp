// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/stereo_object_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "made_road_users.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::stereo_object_detector_test {
namespace {

TEST(StereoObjectDetector, FindsACarAhead) {
  const std::vector<Object> objects = objectsIn(sceneOf({carAt(10.0, 0.0)}));
  ASSERT_EQ(objects.size(), 1U);
  const Object& car = objects.front();
  EXPECT_EQ(car.objectClass(), ObjectClass::kVehicle);
  EXPECT_GT(car.class_probabilities[static_cast<std::size_t>(ObjectClass::kVehicle)], 0.5);
  EXPECT_NEAR(car.height, 1.5, 0.1);
  EXPECT_NEAR(-rearOf(car).position, 10.0, 0.1);
  EXPECT_NEAR(leftOf(car).position, 0.9, 0.1);
  EXPECT_NEAR(rightOf(car).position, 0.9, 0.1);
  EXPECT_LT(leftOf(car).variance, 0.1);
  EXPECT_LT(rightOf(car).variance, 0.1);
  EXPECT_EQ(sideToward(car, {1.0, 0.0}).variance, kHiddenSide) << "it faces away";
  EXPECT_EQ(car.sensors, std::vector<std::string>{"stereo"});
  EXPECT_EQ(car.dynamic_state, DynamicState::kUnknown);
  EXPECT_FALSE(car.points.empty());
  EXPECT_LE(car.points.size(), 40U);
}

TEST(StereoObjectDetector, FindsACarFarAwayInNoise) {
  MadeScene scene = sceneOf({carAt(25.0, 2.0)});
  scene.disparity_noise = 0.25;
  const std::vector<Object> objects = objectsIn(scene);
  ASSERT_EQ(objects.size(), 1U);
  const Object& car = objects.front();
  EXPECT_EQ(car.objectClass(), ObjectClass::kVehicle);
  const double sigma = std::sqrt(car.position_covariance(0, 0) + rearOf(car).variance);
  EXPECT_NEAR(-rearOf(car).position, 25.0, 3.0 * sigma);
  EXPECT_LT(sigma, 1.0);
}

TEST(StereoObjectDetector, DistinguishesPedestrianCyclistAndPole) {
  const std::vector<Object> objects =
      objectsIn(sceneOf({pedestrianAt(10.0, 3.0), boxAt(10.0, 0.0, {0.6, 1.6, 1.75}),
                         boxAt(10.0, -3.0, {0.15, 0.15, 4.0})}));
  ASSERT_EQ(objects.size(), 3U);
  EXPECT_EQ(objects[0].objectClass(), ObjectClass::kPedestrian);
  EXPECT_EQ(objects[1].objectClass(), ObjectClass::kCyclist);
  EXPECT_EQ(objects[2].objectClass(), ObjectClass::kPole);
}

TEST(StereoObjectDetector, LeavesOutWallsHousesAndCurbs) {
  EXPECT_TRUE(objectsIn(sceneOf({wallAt(16.0, 30.0)})).empty()) << "a long one, 2 m high";
  EXPECT_TRUE(objectsIn(sceneOf({boxAt(16.0, 0.0, {5.0, 5.0, 9.0})})).empty()) << "a high one";
  EXPECT_TRUE(objectsIn(sceneOf({boxAt(6.0, 3.0, {20.0, 1.0, 0.15})})).empty()) << "a curb";
  EXPECT_TRUE(objectsIn(sceneOf({})).empty());
}

TEST(StereoObjectDetector, UnlikelyRoadUsersHaveOddsAgainstThem) {
  const std::vector<Object> objects =
      objectsIn(sceneOf({carAt(10.0, 3.0), boxAt(10.0, -2.0, {0.8, 2.4, 0.9})}));
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].log_odds, 0.0) << "no proof of one";
  EXPECT_LT(objects[1].log_odds, -0.5) << "hedge";
  EXPECT_GE(objects[1].log_odds, -StereoObjectDetectorOptions().max_doubt);
}

TEST(StereoObjectDetector, SeesObjectsBehindAndAboveNearerOnes) {
  const std::vector<Object> objects =
      objectsIn(sceneOf({carAt(9.0, 0.0), boxAt(18.0, 0.0, {9.0, 2.5, 3.4})}));
  ASSERT_EQ(objects.size(), 2U) << "a truck, seen over a car";
  EXPECT_NEAR(-rearOf(nearest(objects)).position, 9.0, 0.1);
  const bool first = &nearest(objects) == &objects[0];
  EXPECT_NEAR(-rearOf(objects[first ? 1 : 0]).position, 18.0, 0.2);
}

TEST(StereoObjectDetector, MarksAnEndThatSomethingNearerHides) {
  const std::vector<Object> objects =
      objectsIn(sceneOf({boxAt(7.0, 0.6, {0.6, 1.2, 1.9}), carAt(15.0, 0.0)}));
  ASSERT_EQ(objects.size(), 2U);
  const bool first = objects[0].box.center.x() > 12.0;
  const Object& car = objects[first ? 0 : 1];
  EXPECT_EQ(leftOf(car).variance, kHiddenSide);
  EXPECT_LT(rightOf(car).variance, 0.1);
  EXPECT_NEAR(leastCorner(car).y(), -0.9, 0.15);
}

TEST(StereoObjectDetector, MarksAnEndAtTheImagesBorder) {
  // Half of the car is outside the image, beyond a tangent of 0.5.
  const std::vector<Object> objects = objectsIn(sceneOf({carAt(8.5, -4.0)}));
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(rightOf(objects[0]).variance, kHiddenSide);
  EXPECT_LT(leftOf(objects[0]).variance, 0.2);
}

/// The far end lies along the line of sight, however far it is from the camera's axis: a car that
/// drives away, seen at the border of the image.
TEST(StereoObjectDetector, AnEndInDepthIsNotSeenInTheImage) {
  MadeScene scene = sceneOf({carAt(14.0, 2.4)});
  scene.camera_yaw = degrees(34.0);
  scene.disparity_noise = 0.2;
  const std::vector<Object> objects = objectsIn(scene);
  ASSERT_FALSE(objects.empty());
  const Object& car = nearest(objects);
  EXPECT_LT(rearOf(car).variance, 0.1);
  EXPECT_EQ(sideToward(car, {1.0, 0.0}).variance, kHiddenSide);
}

TEST(StereoObjectDetector, CommonDepthErrorsAreInThePosition) {
  MadeCloud made(sceneOf({carAt(20.0, 0.0)}));
  const std::vector<Object> before = detect(made).list.objects;
  made.cloud().camera.disparity_offset_variance = 1.0;
  const std::vector<Object> after = detect(made).list.objects;
  ASSERT_EQ(before.size(), 1U);
  ASSERT_EQ(after.size(), 1U);
  const double depth = 20.0 - kCameraX;
  const double common = depth * depth / (400.0 * 0.5);
  EXPECT_NEAR(after[0].position_covariance(0, 0) - before[0].position_covariance(0, 0),
              common * common, 0.02 * common * common)
      << "1 px at a focal length of 400 px and a baseline of 0.5 m";
}

TEST(StereoObjectDetector, HasNoEvidenceWhereTheRightCameraIsBlind) {
  // The left camera sees the car's left side, the right one does not: it is 0.5 m to the right.
  const std::vector<Object> objects = objectsIn(sceneOf({carAt(8.5, 2.85)}));
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(leftOf(objects[0]).variance, kHiddenSide);
}

TEST(StereoObjectDetector, SeparatesObjectsThatTouchInTheImage) {
  MadeScene scene =
      sceneOf({boxAt(12.0, -1.9, {1.8, 0.6, 1.75}), boxAt(10.0, -3.25, {5.2, 2.0, 2.2})});
  scene.disparity_noise = 0.25;
  const std::vector<Object> objects = objectsIn(scene);
  ASSERT_EQ(objects.size(), 2U) << "a cyclist who passes a parked van";
  const bool first = objects[0].box.center.y() > objects[1].box.center.y();
  const Object& cyclist = objects[first ? 0 : 1];
  EXPECT_NEAR(cyclist.box.center.y(), -1.9, 0.3);
  EXPECT_NEAR(leastCorner(cyclist).x(), 12.0, 0.3);
}

TEST(StereoObjectDetector, APedestrianNextToAPoleIsSeparate) {
  const std::vector<Object> objects =
      objectsIn(sceneOf({pedestrianAt(10.0, 0.5), boxAt(10.0, 0.05, {0.2, 0.2, 4.5})}));
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].objectClass(), ObjectClass::kPedestrian);
  EXPECT_EQ(objects[1].objectClass(), ObjectClass::kPole);
}

TEST(StereoObjectDetector, SeesAWholeObjectThroughItsHoles) {
  // Windows: the rear of the car appears farther away through them.
  MadeScene scene = sceneOf({boxAt(12.0, 0.0, {0.3, 1.8, 0.9}), boxAt(12.8, 0.0, {3.0, 1.6, 1.5})});
  scene.disparity_noise = 0.25;
  const std::vector<Object> objects = objectsIn(scene);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_NEAR(objects[0].height, 1.5, 0.15);
  EXPECT_NEAR(-rearOf(objects[0]).position, 12.0, 0.3);
}

TEST(StereoObjectDetector, ReportsNothingBeyondItsRange) {
  MadeCloud made(sceneOf({carAt(20.0, 0.0)}));
  StereoObjectDetectorOptions options;
  EXPECT_EQ(detect(made, options).list.objects.size(), 1U);
  options.effective_range = 18.0;
  EXPECT_TRUE(detect(made, options).list.objects.empty());
}

TEST(StereoObjectDetector, ThinnedCloudsShowTheSame) {
  MadeScene scene = sceneOf({carAt(12.0, 1.0), pedestrianAt(9.0, -2.0)});
  for (const int step : {1, 2, 3}) {
    scene.step = step;
    const std::vector<Object> objects = objectsIn(scene);
    ASSERT_EQ(objects.size(), 2U) << step;
    EXPECT_EQ(objects[0].objectClass(), ObjectClass::kVehicle) << step;
    EXPECT_EQ(objects[1].objectClass(), ObjectClass::kPedestrian) << step;
    EXPECT_NEAR(-rearOf(objects[0]).position, 12.0, 0.15) << step;
    EXPECT_NEAR(objects[0].height, 1.5, 0.2) << step;
    EXPECT_NEAR(leftOf(objects[1]).position + rightOf(objects[1]).position, 0.5, 0.1) << step;
  }
}

TEST(StereoObjectDetector, OrderOfPointsDoesNotMatter) {
  MadeScene scene = sceneOf({carAt(12.0, 1.0), pedestrianAt(9.0, -2.0)});
  scene.disparity_noise = 0.25;
  MadeCloud made(scene);
  MadeCloud backward;
  const PointsView points = made.cloud().points;
  for (std::size_t i = points.count; i-- > 0;) {
    backward.add(points[i].cast<double>());
  }
  StereoObjectDetectorOptions options;
  options.road.estimate = false;  // it uses only some of the points
  const std::vector<Object> one = detect(made, options).list.objects;
  const std::vector<Object> other = detect(backward, options).list.objects;
  ASSERT_EQ(one.size(), 2U);
  ASSERT_EQ(other.size(), 2U);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_NEAR(one[i].box.center.x(), other[i].box.center.x(), 1e-4);
    EXPECT_NEAR(one[i].box.center.y(), other[i].box.center.y(), 1e-4);
    EXPECT_EQ(one[i].class_probabilities, other[i].class_probabilities);
  }
}

TEST(StereoObjectDetector, SameCloudsGiveTheSameObjects) {
  MadeScene scene = sceneOf({carAt(12.0, 1.0), pedestrianAt(9.0, -2.0)});
  scene.disparity_noise = 0.25;
  MadeCloud made(scene);
  StereoObjectDetector detector{StereoObjectDetectorOptions()};
  const ObjectList first = detector.detect(made.cloud()).list;
  detector.reset();
  const ObjectList again = detector.detect(made.cloud()).list;
  ASSERT_EQ(first.objects.size(), 2U);
  ASSERT_EQ(again.objects.size(), 2U);
  for (std::size_t i = 0; i < first.objects.size(); ++i) {
    EXPECT_EQ(first.objects[i].box.center.position(), again.objects[i].box.center.position());
    EXPECT_EQ(first.objects[i].heading_variance, again.objects[i].heading_variance);
    EXPECT_EQ(first.objects[i].class_probabilities, again.objects[i].class_probabilities);
  }
}

TEST(StereoObjectDetector, FollowsTheRoad) {
  MadeScene scene = sceneOf({carAt(18.0, 0.0)});
  scene.unknown_pitch = degrees(1.0);  // the road seems to rise by 0.3 m up to the car
  const std::vector<Object> objects = objectsIn(scene);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_NEAR(objects[0].height, 1.5, 0.15);
}

TEST(StereoObjectDetector, ReportsItsFieldOfView) {
  MadeScene scene = sceneOf({});
  scene.camera_yaw = 0.3;
  MadeCloud made(scene);
  const StereoObjects result = detect(made);
  EXPECT_EQ(result.list.stamp, made.cloud().stamp);
  EXPECT_GT(result.points, 10000U);
  EXPECT_TRUE(result.road_seen);
  ASSERT_EQ(result.list.views.size(), 1U);
  const SensorView& view = result.list.views[0];
  EXPECT_EQ(view.sensor, "stereo");
  EXPECT_NEAR(view.field.sensor_in_base.x(), kCameraX, 1e-9);
  EXPECT_NEAR(view.field.sensor_in_base.heading(), 0.3, 1e-6);
  EXPECT_NEAR(view.field.min_bearing, -std::atan(0.5), 1e-9);
  EXPECT_NEAR(view.field.max_bearing, std::atan(0.5), 1e-9);
  EXPECT_EQ(view.field.range, StereoObjectDetectorOptions().effective_range);
  EXPECT_LE(view.field.sure_range, view.field.range);
}

TEST(StereoObjectDetector, AcceptsCloudsWithoutPoints) {
  MadeCloud made;
  EXPECT_TRUE(detect(made).list.objects.empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  made.add({nan, nan, nan});
  const StereoObjects result = detect(made);
  EXPECT_TRUE(result.list.objects.empty());
  EXPECT_EQ(result.points, 0U);
  EXPECT_EQ(result.list.views.size(), 1U) << "it looked, and saw nothing";
}

TEST(StereoObjectDetector, AcceptsCamerasOfAnyImageSize) {
  MadeCloud made(sceneOf({carAt(10.0, 0.0)}));
  made.cloud().camera.focal_length = 1e5;  // 100,000 px wide; it is then downsampled
  EXPECT_EQ(detect(made).list.objects.size(), 1U);
  made.cloud().camera.focal_length = 10.0;
  EXPECT_NO_THROW(detect(made));
}

TEST(StereoObjectDetector, RefusesCamerasThatMeasureNothing) {
  MadeCloud made(sceneOf({}));
  made.cloud().camera.noise = DepthNoise();
  EXPECT_THROW(detect(made), std::invalid_argument);
  StereoObjectDetectorOptions options;
  options.noise.edge_sigma = -1.0;
  EXPECT_THROW(StereoObjectDetector{options}, OptionError);
}

TEST(StereoObjectDetector, UncertaintyIsAlongTheLineOfSightAndGrowsWithDepth) {
  const std::vector<Object> objects = objectsIn(sceneOf({pedestrianAt(20.0, 6.0)}), ofBoxes());
  ASSERT_EQ(objects.size(), 1U);
  const Point2 ray = (objects[0].box.center.position() - Point2(kCameraX, 0.0)).normalized();
  const Point2 aside(-ray.y(), ray.x());
  const Eigen::Matrix2d& covariance = objects[0].position_covariance;
  EXPECT_GT(ray.dot(covariance * ray), 4.0 * aside.dot(covariance * aside));
  EXPECT_NEAR(ray.dot(covariance * aside), 0.0, 0.05 * ray.dot(covariance * ray));
  const std::vector<Object> near = objectsIn(sceneOf({pedestrianAt(10.0, 3.0)}), ofBoxes());
  ASSERT_EQ(near.size(), 1U);
  EXPECT_LT(near[0].position_covariance.trace(), 0.5 * covariance.trace());
}

}  // namespace
}  // namespace datmo::stereo_object_detector_test
