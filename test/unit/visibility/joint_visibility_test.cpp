// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/visibility/joint_visibility.h"

#include <gtest/gtest.h>

namespace datmo::joint_visibility_test {
namespace {

const VisibilityOptions kOptions;

FieldOfView fieldOf(double half_width) { return {Pose2(), -half_width, half_width, 60.0, 60.0}; }

Object objectOf(const Box2& box, const std::vector<std::string>& sensors) {
  Object object;
  object.box = box;
  object.sensors = sensors;
  return object;
}

const Box2 kVan{{10.0, 0.0, 0.0}, 5.0, 2.0};
const Box2 kBehindVan{{30.0, 0.0, 0.0}, 4.0, 1.8};
const Box2 kToTheLeft{{0.0, 20.0, 0.0}, 4.0, 1.8};

/// A scanner that sees only to the left.
Visibility scanner() {
  const FieldOfView left{Pose2(0.0, 0.0, degrees(90.0)), degrees(-60.0), degrees(60.0), 60.0, 60.0};
  return {left, {}, kOptions};
}

double seen(const Visibility* scan, const ObjectList& list, const Box2& box) {
  return jointVisibility(scan, list, kOptions).detectionProbability(box, 0.0);
}

TEST(JointVisibility, WithoutSensorsItIsUnknown) {
  EXPECT_EQ(seen(nullptr, {}, kBehindVan), kOptions.unknown_probability);
}

TEST(JointVisibility, WithoutViewsItIsTheScans) {
  const Visibility scan = scanner();
  for (const Box2& box : {kVan, kBehindVan, kToTheLeft}) {
    EXPECT_EQ(seen(&scan, {}, box), scan.detectionProbability(box, 0.0));
  }
}

TEST(JointVisibility, WithoutAScanItIsThatOfTheViewsAlone) {
  const ObjectList list{{}, {}, {{"camera", fieldOf(degrees(30.0))}}};
  EXPECT_GT(seen(nullptr, list, kVan), 0.9);
  EXPECT_EQ(seen(nullptr, list, kToTheLeft), kOptions.min_probability)
      << "an unknown view does not add its chance";
}

TEST(JointVisibility, EitherSensorDetects) {
  const Visibility scan = scanner();
  const ObjectList list{{}, {}, {{"camera", fieldOf(degrees(30.0))}}};
  EXPECT_GT(seen(&scan, list, kVan), 0.9) << "by the camera alone";
  EXPECT_GT(seen(&scan, list, kToTheLeft), 0.9) << "by the scanner alone";
  const Box2 at_the_rear{{-20.0, 0.0, 0.0}, 4.0, 1.8};
  EXPECT_LT(seen(&scan, list, at_the_rear), 0.05) << "by none";
}

TEST(JointVisibility, IndependentChancesJoin) {
  const double far = 40.0;
  const FieldOfView weak{Pose2(), degrees(-90.0), degrees(90.0), 20.0, 60.0};
  const Box2 box{{far, 0.0, 0.0}, 0.6, 0.6};
  const double one = Visibility(weak, {}, kOptions).detectionProbability(box, 0.0);
  ASSERT_NEAR(one, 0.5 * kOptions.max_probability, 0.01);
  EXPECT_NEAR(seen(nullptr, {{}, {}, {{"a", weak}, {"b", weak}}}, box),
              1.0 - (1.0 - one) * (1.0 - one), 1e-9);
  const FieldOfView clear = fieldOf(degrees(90.0));
  EXPECT_EQ(seen(nullptr, {{}, {}, {{"a", clear}, {"b", clear}}}, box), kOptions.max_probability)
      << "nothing is surer than that";
}

TEST(JointVisibility, ObjectsOccludeOnlyForTheSensorThatSawThem) {
  ObjectList list{{}, {objectOf(kVan, {"camera"})}, {{"camera", fieldOf(degrees(30.0))}}};
  EXPECT_EQ(seen(nullptr, list, kBehindVan), kOptions.min_probability);
  list.objects[0].sensors = {"lidar"};
  EXPECT_GT(seen(nullptr, list, kBehindVan), 0.9) << "the camera looked over it";
  list.objects[0].sensors = {"lidar", "camera"};
  EXPECT_EQ(seen(nullptr, list, kBehindVan), kOptions.min_probability);
  list.views.push_back({"roadside", {Pose2(60.0, 0.0, kPi), -0.5, 0.5, 60.0, 60.0}});
  EXPECT_GT(seen(nullptr, list, kBehindVan), 0.9) << "seen from the other side";
}

}  // namespace
}  // namespace datmo::joint_visibility_test
