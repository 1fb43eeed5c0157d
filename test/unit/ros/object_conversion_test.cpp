// SPDX-License-Identifier: BSD-3-Clause
#include "message_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo::object_conversion_test {
namespace {

const Stamp kStamp = Stamp::fromSeconds(samples::kStart);

TEST(ObjectConversion, RoundTrip) {
  Object object;
  object.box = {{5.0, 6.0, 0.5}, 4.0, 2.0};
  object.position_covariance << 0.5, 0.1, 0.1, 0.25;
  object.heading_variance = 0.04;
  object.side_variance = {0.0, kHiddenSide, 0.25, 0.5};
  object.height = 1.5;
  object.object_class = ObjectClass::kVehicle;
  object.class_probability = 0.75;
  object.dynamic_state = DynamicState::kMoving;
  object.velocity = MeasuredVelocity{{1.5, -2.0}, Eigen::Matrix2d::Identity()};
  object.velocity->covariance(0, 1) = object.velocity->covariance(1, 0) = 0.25;
  object.moving_fraction = 0.5;
  object.log_odds = -2.5;
  object.motion_log_odds = -3.0;
  object.sensors = {"lidar"};
  object.points = {Point2(4.0, 5.0)};
  const ObjectList back = fromMessage(toMessage(ObjectList{kStamp, {object}, {}}, "base_link"));
  EXPECT_EQ(back.stamp, kStamp);
  ASSERT_EQ(back.objects.size(), 1U);
  const Object& got = back.objects[0];
  EXPECT_NEAR(got.box.center.heading(), 0.5, 1e-12);
  EXPECT_EQ(got.box.length, 4.0);
  EXPECT_EQ(got.box.width, 2.0);
  EXPECT_EQ(got.position_covariance, object.position_covariance);
  EXPECT_EQ(got.heading_variance, 0.04);
  EXPECT_EQ(got.side_variance, object.side_variance);
  EXPECT_EQ(got.height, 1.5);
  EXPECT_EQ(got.object_class, ObjectClass::kVehicle);
  EXPECT_EQ(got.class_probability, 0.75);
  EXPECT_EQ(got.dynamic_state, DynamicState::kMoving);
  ASSERT_TRUE(got.velocity);
  EXPECT_EQ(got.velocity->velocity, object.velocity->velocity);
  EXPECT_EQ(got.velocity->covariance, object.velocity->covariance);
  EXPECT_EQ(got.moving_fraction, 0.5);
  EXPECT_EQ(got.log_odds, -2.5);
  EXPECT_EQ(got.motion_log_odds, -3.0);
  EXPECT_EQ(got.sensors, object.sensors);
  EXPECT_EQ(got.points.at(0), Point2(4.0, 5.0));
}

TEST(ObjectConversion, AVelocityWithoutCovarianceWasNotMeasured) {
  ObjectArray message;
  message.objects.resize(1);
  message.objects[0].velocity.x = 3.0;
  EXPECT_FALSE(fromMessage(message).objects[0].velocity);
}

TEST(ObjectConversion, AnUnknownClassBecomesUnknown) {
  ObjectArray message;
  message.objects.resize(1);
  message.objects[0].classification = 200;
  message.objects[0].dynamic_state = 200;
  const ObjectList list = fromMessage(message);
  EXPECT_EQ(list.objects[0].object_class, ObjectClass::kUnknown);
  EXPECT_EQ(list.objects[0].dynamic_state, DynamicState::kUnknown);
}

}  // namespace
}  // namespace datmo::object_conversion_test
