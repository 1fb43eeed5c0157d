// SPDX-License-Identifier: BSD-3-Clause
// Fusion of the classes that an image gives to the scanner's objects.
#include <utility>
#include <vector>

#include "fusion_objects.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/fusion/object/object_fuser.h"

namespace datmo::object_names_test {
namespace {

Object nameOfVehicle(const Object& of) { return classOnly(of, ObjectClass::kVehicle, 0.8); }

ObjectFusionResult fuseNames(std::vector<Object> seen, std::vector<Object> names,
                             const LabeledScan* scan = nullptr) {
  ObjectFuserOptions options;
  options.sources["mono"];
  return ObjectFuser(options).fuse(
      {received("lidar", std::move(seen)), received("mono", std::move(names))}, scan);
}

TEST(ObjectNames, ANameAddsOnlyAClass) {
  Object seen = boxObject(15.0, 4.0, 0.3, 2.2, 0.03);
  hide(seen, BoxSide::kFront);
  seen.moving_fraction = 0.25;
  const LabeledScan scan = scanAhead(30.0, PointState::kStatic);
  const auto named = fuseNames({seen}, {nameOfVehicle(seen)}, &scan);
  const auto alone = fuseNames({seen}, {}, &scan);
  ASSERT_EQ(named.list.objects.size(), 1U);
  EXPECT_EQ(named.counts.fused, 1U);
  const Object& object = named.list.objects[0];
  const Object& expected = alone.list.objects[0];
  EXPECT_EQ(object.class_probabilities, reportedClass(ObjectClass::kVehicle, 0.8));
  EXPECT_EQ(object.log_odds, expected.log_odds) << "it exists no more surely";
  EXPECT_EQ(object.moving_fraction, expected.moving_fraction);
  EXPECT_EQ(object.position_covariance, expected.position_covariance);
  EXPECT_EQ(object.side_variance, expected.side_variance);
}

TEST(ObjectNames, AClassWithoutItsObjectIsNoObject) {
  const Object gone = boxObject(15.0, 4.0, 0.3, 2.2, 0.03);
  const ObjectFusionResult left_out = fuseNames({}, {nameOfVehicle(gone)});
  EXPECT_TRUE(left_out.list.objects.empty());
  EXPECT_EQ(left_out.counts.unmatched_classes, 1U);
  Object alone = nameOfVehicle(gone);
  alone.sensors = {"mono"};
  EXPECT_EQ(fuseNames({}, {alone}).list.objects.size(), 1U) << "what the image alone has is one";
}

/// As output by RadarObjectDetector: no side, but a velocity, under a custom source name.
Object radarObject(double x) {
  Object object = pointObject(x, 4.0, 0.3, "radar");
  object.side_variance.fill(kHiddenSide);
  object.velocity = MeasuredVelocity{Eigen::Vector2d(8.0, 0.0), Eigen::Matrix2d::Identity(), 0.01};
  return object;
}

ObjectFusionResult fuseFrontRadar(std::vector<Object> seen, std::vector<Object> by_radar) {
  ObjectFuserOptions options;
  options.sources["front_radar"];
  return ObjectFuser(options).fuse(
      {received("lidar", std::move(seen)), received("front_radar", std::move(by_radar))}, nullptr);
}

TEST(ObjectNames, ARadarUnderAnotherNameSeesObjects) {
  const auto alone = fuseFrontRadar({}, {radarObject(15.0)});
  EXPECT_EQ(alone.list.objects.size(), 1U);
  EXPECT_EQ(alone.counts.unmatched_classes, 0U);
  const Object seen = pointObject(15.0, 4.0, 0.3);
  const auto both = fuseFrontRadar({seen}, {radarObject(15.0)});
  ASSERT_EQ(both.list.objects.size(), 1U);
  EXPECT_GT(both.list.objects[0].log_odds, seen.log_odds);
  EXPECT_TRUE(both.list.objects[0].velocity);
}

TEST(ObjectNames, AnIndependentSensorSeesObjects) {
  Object object = pointObject(15.0, 4.0, 0.3, "far_camera");
  object.side_variance.fill(kHiddenSide);
  EXPECT_EQ(fuseFrontRadar({}, {object}).list.objects.size(), 1U);
}

TEST(ObjectNames, ANameIsOneUnderAnyNameOfItsSource) {
  ObjectFuserOptions options;
  options.sources = {{"front_lidar", {}}, {"mono", {}}};
  options.scanner = "front_lidar";
  const Object gone = boxObject(15.0, 4.0, 0.3, 2.2, 0.03);
  const Object other = boxObject(40.0, -9.0, 0.3, 2.2, 0.03);
  const auto result = ObjectFuser(options).fuse(
      {received("front_lidar", {other}), received("mono", {nameOfVehicle(gone)})}, nullptr);
  EXPECT_EQ(result.list.objects.size(), 1U);
  EXPECT_EQ(result.counts.unmatched_classes, 1U);
}

}  // namespace
}  // namespace datmo::object_names_test
