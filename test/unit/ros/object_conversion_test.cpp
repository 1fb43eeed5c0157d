// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <vector>

#include "message_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/stamp_check.h"
#include "datmo_fusion/tracking/object_check.h"

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
  object.class_probabilities = reportedClass(ObjectClass::kVehicle, 0.75);
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
  EXPECT_EQ(got.class_probabilities, object.class_probabilities);
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

TEST(ObjectConversion, TheMostLikelyClassIsReportedBesideAllProbabilities) {
  ObjectList list;
  list.objects.resize(1);
  list.objects[0].class_probabilities = {0.0, 0.25, 0.5, 0.25, 0.0};
  const ObjectMessage message = toMessage(list, "base_link").objects[0];
  EXPECT_EQ(message.classification, ObjectMessage::CLASS_CYCLIST);
  EXPECT_EQ(message.class_probability, 0.5F);
  EXPECT_EQ(message.class_probabilities, (std::vector<float>{0.0F, 0.25F, 0.5F, 0.25F, 0.0F}));
}

TEST(ObjectConversion, AReportOfOneClassIsKeptAsItIs) {
  ObjectArray message;
  message.objects.resize(1);
  message.objects[0].classification = ObjectMessage::CLASS_VEHICLE;
  message.objects[0].class_probability = 0.75F;
  EXPECT_EQ(fromMessage(message).objects[0].class_probabilities,
            reportedClass(ObjectClass::kVehicle, 0.75));
}

TEST(ObjectConversion, ClassProbabilitiesThatAreNoneAreInvalid) {
  Object object;
  object.class_probabilities = reportedClass(ObjectClass::kVehicle, 0.75);
  const ObjectArray good = toMessage(ObjectList{kStamp, {object}, {}}, "base_link");
  const auto isValidWith = [&good](float probability, const std::vector<float>& all) {
    ObjectArray message = good;
    message.objects[0].class_probability = probability;
    message.objects[0].class_probabilities = all;
    return isValid(fromMessage(message).objects[0]);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(isValidWith(0.75F, {}));
  EXPECT_TRUE(isValidWith(0.5F, {0.0F, 0.25F, 0.5F, 0.25F, 0.0F}));
  EXPECT_FALSE(isValidWith(0.5F, {0.5F, 0.5F})) << "another number of classes";
  EXPECT_FALSE(isValidWith(0.5F, {0.0F, 0.5F, 0.5F, 0.5F, 0.0F})) << "1.5 in all";
  EXPECT_FALSE(isValidWith(0.5F, {0.0F, nan, 0.5F, 0.25F, 0.0F}));
  EXPECT_FALSE(isValidWith(nan, {0.0F, 0.25F, 0.5F, 0.25F, 0.0F}));
  EXPECT_FALSE(isValidWith(7.0F, {0.0F, 0.25F, 0.5F, 0.25F, 0.0F}));
  EXPECT_FALSE(isValidWith(nan, {}));
  EXPECT_FALSE(isValidWith(-1.0F, {}));
}

TEST(ObjectConversion, AnUnknownClassBecomesUnknown) {
  ObjectArray message;
  message.objects.resize(1);
  message.objects[0].classification = 200;
  message.objects[0].dynamic_state = 200;
  const ObjectList list = fromMessage(message);
  EXPECT_EQ(list.objects[0].class_probabilities, ClassProbabilities{});
  EXPECT_EQ(list.objects[0].dynamic_state, DynamicState::kUnknown);
}

}  // namespace
}  // namespace datmo::object_conversion_test
