// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/class_camera.h"

#include <map>

#include "made_worlds.h"
#include <gtest/gtest.h>

namespace datmo::simulator::class_camera_test {
namespace {

constexpr int kImages = 4000;

ClassCamera cameraOf(const ClassCameraOptions& options = {}) {
  return {options, RandomStream(1, "mono")};
}

World worldWith(const std::string& kind, const Pose2& center) {
  World world = emptyWorld();
  world.addStanding(objectKind(kind), center);
  return world;
}

std::map<ObjectClass, int> reportsOf(const std::string& kind) {
  ClassCamera camera = cameraOf();
  const World world = worldWith(kind, {20.0, 0.0, 0.0});
  std::map<ObjectClass, int> reports;
  for (int image = 0; image < kImages; ++image) {
    for (const Object& object : camera.measure(world, 0.0).objects) {
      ++reports[object.objectClass()];
    }
  }
  return reports;
}

TEST(ClassCameraTest, ReportsAsTheMatrixSays) {
  auto cyclist = reportsOf("cyclist");
  EXPECT_NEAR(cyclist[ObjectClass::kPedestrian], 0.1 * kImages, 0.02 * kImages);
  EXPECT_NEAR(cyclist[ObjectClass::kCyclist], 0.82 * kImages, 0.02 * kImages);
  EXPECT_EQ(cyclist[ObjectClass::kVehicle], 0);
  auto van = reportsOf("van");
  EXPECT_NEAR(van[ObjectClass::kVehicle], 0.95 * kImages, 0.02 * kImages);
  EXPECT_TRUE(reportsOf("pole").empty());
}

TEST(ClassCameraTest, TheProbabilitiesOfAReportAreTheSharesOfEachClassInIt) {
  ClassCamera camera = cameraOf();
  const World world = worldWith("cyclist", {20.0, 0.0, 0.0});
  ObjectList list;
  while (list.objects.empty() || list.objects[0].objectClass() != ObjectClass::kCyclist) {
    list = camera.measure(world, 0.0);
  }
  const ClassProbabilities& all = list.objects[0].class_probabilities;
  EXPECT_NEAR(all[static_cast<std::size_t>(ObjectClass::kPedestrian)], 0.1 / 0.93, 1e-9);
  EXPECT_NEAR(all[static_cast<std::size_t>(ObjectClass::kCyclist)], 0.82 / 0.93, 1e-9);
  EXPECT_NEAR(all[static_cast<std::size_t>(ObjectClass::kVehicle)], 0.01 / 0.93, 1e-9);
  EXPECT_EQ(list.objects[0].sensors, std::vector<std::string>{"mono"});
}

TEST(ClassCameraTest, PositionErrorsAreConsistentWithTheCovariance) {
  ClassCamera camera = cameraOf();
  const World world = worldWith("car", {20.0, 5.0, 0.0});
  double sum = 0.0;
  int reports = 0;
  for (int image = 0; image < kImages; ++image) {
    for (const Object& object : camera.measure(world, 0.0).objects) {
      const Point2 error = object.box.center.position() - Point2(20.0, 5.0);
      sum += error.dot(object.position_covariance.inverse() * error);
      ++reports;
    }
  }
  EXPECT_NEAR(sum / reports, 2.0, 0.15) << "NEES";
}

TEST(ClassCameraTest, HiddenDistantOrLateralObjectsAreNotReported) {
  ClassCamera camera = cameraOf();
  World hidden = worldWith("car", {20.0, 0.0, 0.0});
  hidden.addSolid(wallAt(10.0));
  const World far = worldWith("car", {60.0, 0.0, 0.0});
  const World aside = worldWith("car", {5.0, 20.0, 0.0});
  for (int image = 0; image < 20; ++image) {
    EXPECT_TRUE(camera.measure(hidden, 0.0).objects.empty());
    EXPECT_TRUE(camera.measure(far, 0.0).objects.empty());
    EXPECT_TRUE(camera.measure(aside, 0.0).objects.empty());
  }
}

TEST(ClassCameraTest, AnInvalidMatrixIsRefused) {
  ClassCameraOptions options;
  options.confusion = {1.0, 0.0, 0.0};
  EXPECT_THROW(cameraOf(options), OptionError);
  options.confusion = {0.9, 0.2, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  EXPECT_THROW(cameraOf(options), OptionError);
}

}  // namespace
}  // namespace datmo::simulator::class_camera_test
