#include "message_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/message_conversion.h"
#include "datmo_fusion/ros/stamp_check.h"

namespace datmo {
namespace {

const Stamp kStamp = Stamp::fromSeconds(samples::kStart);

TEST(ObjectConversion, ThereAndBack) {
  Object object;
  object.box = {{5.0, 6.0, 0.5}, 4.0, 2.0};
  object.position_covariance << 0.5, 0.1, 0.1, 0.25;
  object.heading_variance = 0.04;
  object.side_variance = {0.0, kHiddenSide, 0.25, 0.5};
  object.height = 1.5;
  object.object_class = ObjectClass::kVehicle;
  object.class_probability = 0.75;
  object.dynamic_state = DynamicState::kMoving;
  object.moving_fraction = 0.5;
  object.log_odds = -2.5;
  object.sensors = {"lidar"};
  object.points = {Point2(4.0, 5.0)};
  const ObjectList back = fromMessage(toMessage(ObjectList{kStamp, {object}, {}}, "base_link"));
  EXPECT_EQ(back.stamp, kStamp);
  ASSERT_EQ(back.objects.size(), 1U);
  const Object& got = back.objects[0];
  EXPECT_NEAR(got.box.centre.heading(), 0.5, 1e-12);
  EXPECT_EQ(got.box.length, 4.0);
  EXPECT_EQ(got.box.width, 2.0);
  EXPECT_EQ(got.position_covariance, object.position_covariance);
  EXPECT_EQ(got.heading_variance, 0.04);
  EXPECT_EQ(got.side_variance, object.side_variance);
  EXPECT_EQ(got.height, 1.5);
  EXPECT_EQ(got.object_class, ObjectClass::kVehicle);
  EXPECT_EQ(got.class_probability, 0.75);
  EXPECT_EQ(got.dynamic_state, DynamicState::kMoving);
  EXPECT_EQ(got.moving_fraction, 0.5);
  EXPECT_EQ(got.log_odds, -2.5);
  EXPECT_EQ(got.sensors, object.sensors);
  EXPECT_EQ(got.points.at(0), Point2(4.0, 5.0));
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

TEST(TrackConversion, FillsEveryField) {
  Track track;
  track.id = 5;
  track.state << 1, 2, 3, 4, 5, 6;
  track.covariance(0, 1) = 0.5;
  track.mode_probabilities = {0.5, 0.25, 0.125, 0.0625, 0.0625};
  track.box = {{1.0, 2.0, 0.5}, 4.0, 2.0};
  track.yaw_rate = 0.25;
  track.heading_variance = 0.04;
  track.class_probabilities = {0.125, 0.0, 0.25, 0.625, 0.0};
  track.existence_probability = 0.75;
  track.history = {{kStamp + -0.5, Pose2(0.5, 2.0, 0.25)}, {kStamp, Pose2(1.0, 2.0, 0.5)}};
  track.moving = true;
  track.age = 2.5;
  track.since_update = 0.5;
  track.hits = 9;
  const TrackArray message = toMessage(TrackList{kStamp, {track}, {}}, "map");
  EXPECT_EQ(message.header.frame_id, "map");
  const TrackMessage& got = message.tracks.at(0);
  EXPECT_EQ(got.id, 5U);
  EXPECT_EQ(got.pose.position.x, 1.0);
  EXPECT_EQ(got.velocity.x, 3.0);
  EXPECT_EQ(got.velocity.y, 4.0);
  EXPECT_EQ(got.acceleration.x, 5.0);
  EXPECT_EQ(got.acceleration.y, 6.0);
  EXPECT_EQ(got.covariance[1], 0.5) << "row 0, column 1";
  EXPECT_EQ(got.covariance[6], 0.0) << "row 1, column 0";
  EXPECT_EQ(got.mode_probabilities, (std::vector<float>{0.5F, 0.25F, 0.125F, 0.0625F, 0.0625F}));
  EXPECT_EQ(got.size.x, 4.0);
  EXPECT_EQ(got.size.y, 2.0);
  EXPECT_EQ(got.yaw_rate, 0.25);
  EXPECT_EQ(got.heading_variance, 0.04);
  EXPECT_EQ(got.classification, ObjectMessage::CLASS_VEHICLE);
  EXPECT_EQ(got.class_probability, 0.625F);
  EXPECT_EQ(got.class_probabilities, (std::vector<float>{0.125F, 0.0F, 0.25F, 0.625F, 0.0F}));
  EXPECT_EQ(got.existence_probability, 0.75F);
  ASSERT_EQ(got.history.size(), 2U);
  EXPECT_EQ(toStamp(got.history[0].stamp), kStamp + -0.5);
  EXPECT_EQ(got.history[0].pose.x, 0.5);
  EXPECT_EQ(got.history[0].pose.y, 2.0);
  EXPECT_EQ(got.history[0].pose.theta, 0.25);
  EXPECT_TRUE(got.moving);
  EXPECT_EQ(got.age, ros::Duration(2.5));
  EXPECT_EQ(got.since_update, ros::Duration(0.5));
  EXPECT_EQ(got.hits, 9U);
}

}  // namespace
}  // namespace datmo
