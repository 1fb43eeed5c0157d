// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/object_velocity.h"

#include <gtest/gtest.h>

namespace datmo::object_velocity_test {
namespace {

Object objectAt(double x, double y) {
  Object object;
  object.box = {Pose2(x, y, 0.0), 0.6, 0.6};
  object.position_covariance = 0.01 * Eigen::Matrix2d::Identity();
  return object;
}

PointVelocity pointAt(double x, double y, double height, const Eigen::Vector3d& velocity) {
  PointVelocity point;
  point.position = {x, y, height};
  point.velocity = velocity;
  point.covariance = 0.04 * Eigen::Matrix3d::Identity();
  return point;
}

TEST(ObjectVelocity, EachObjectHasTheVelocityOfThePointsInItsBox) {
  std::vector<Object> objects{objectAt(10.0, 0.0), objectAt(10.0, 1.0), objectAt(20.0, 0.0)};
  const Eigen::Vector3d walks(0.0, 1.4, 0.0);
  const Eigen::Vector3d stands = Eigen::Vector3d::Zero();
  const std::vector<PointVelocity> points{
      pointAt(10.1, 0.1, 1.0, walks),  pointAt(9.9, 0.0, 1.5, walks),
      pointAt(10.0, 0.2, 0.5, walks),  pointAt(10.0, 1.1, 1.0, stands),
      pointAt(10.1, 0.9, 1.2, stands), pointAt(10.0, 1.0, 0.8, stands)};
  measureVelocities(points, ObjectVelocityOptions(), objects);
  ASSERT_TRUE(objects[0].velocity && objects[1].velocity);
  EXPECT_TRUE(objects[0].velocity->velocity.isApprox(Eigen::Vector2d(0.0, 1.4), 1e-3));
  EXPECT_LT(objects[1].velocity->velocity.norm(), 1e-3);
  EXPECT_NEAR(objects[0].velocity->covariance(0, 0), 0.04 / 3.0, 0.002);
  EXPECT_FALSE(objects[2].velocity) << "no point is on it";
}

TEST(ObjectVelocity, PointsOnAParkedCarAreNotTheCyclistsBesideIt) {
  std::vector<Object> objects{objectAt(15.0, -1.9), objectAt(17.0, -2.6)};
  objects[1].box = {Pose2(17.0, -2.6, 0.0), 4.2, 0.0};  // its visible side
  for (Object& object : objects) {
    object.position_covariance = 0.5 * Eigen::Matrix2d::Identity();
  }
  const Eigen::Vector3d rides(4.5, 0.0, 0.0);
  const Eigen::Vector3d stands = Eigen::Vector3d::Zero();
  // All of them nearer to the cyclist's center than to the car's.
  const std::vector<PointVelocity> points{
      pointAt(15.1, -1.9, 1.0, rides),  pointAt(15.0, -2.0, 1.3, rides),
      pointAt(15.2, -2.6, 0.6, stands), pointAt(15.4, -2.5, 0.8, stands),
      pointAt(15.6, -2.6, 0.7, stands), pointAt(15.3, -2.7, 1.0, stands)};
  measureVelocities(points, ObjectVelocityOptions(), objects);
  ASSERT_TRUE(objects[0].velocity && objects[1].velocity);
  EXPECT_NEAR(objects[0].velocity->velocity.x(), 4.5, 1e-3);
  EXPECT_NEAR(objects[1].velocity->velocity.x(), 0.0, 1e-3);
}

TEST(ObjectVelocity, PointsOnTheRoadAndOverheadAreIgnored) {
  std::vector<Object> objects{objectAt(10.0, 0.0)};
  const Eigen::Vector3d moves(5.0, 0.0, 0.0);
  std::vector<PointVelocity> points(5, pointAt(10.0, 0.0, 0.05, moves));
  points.resize(10, pointAt(10.0, 0.0, 6.0, moves));
  measureVelocities(points, ObjectVelocityOptions(), objects);
  EXPECT_FALSE(objects[0].velocity);
}

TEST(ObjectVelocity, EarlierMeasurementsAreForgotten) {
  std::vector<Object> objects{objectAt(10.0, 0.0)};
  objects[0].velocity = MeasuredVelocity{};
  measureVelocities({}, ObjectVelocityOptions(), objects);
  EXPECT_FALSE(objects[0].velocity);
}

}  // namespace
}  // namespace datmo::object_velocity_test
