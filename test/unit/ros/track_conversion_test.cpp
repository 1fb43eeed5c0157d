// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "message_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/stamp_check.h"
#include "datmo_fusion/tracking/track_check.h"

namespace datmo::track_conversion_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const Stamp kStamp = Stamp::fromSeconds(samples::kStart);

/// Numbers that are exact in single precision.
Track sampleTrack() {
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
  track.height = 1.5;
  track.sensors = {"lidar", "stereo"};
  track.sources = {{"lidar", 4}, {"stereo", 9}};
  return track;
}

TrackList sampleList() {
  const ViewFan view{Pose2(1.0, 2.0, 0.5), -1.5, 0.25, 0.125, 40.0, 80.0, true, {10.5, 0.0, 80.0}};
  return {kStamp, {sampleTrack()}, {view}};
}

TEST(TrackConversion, FillsEveryField) {
  const TrackArray message = toMessage(sampleList(), "map");
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
  EXPECT_EQ(got.sensors, (std::vector<std::string>{"lidar", "stereo"}));
  ASSERT_EQ(got.sources.size(), 2U);
  EXPECT_EQ(got.sources[1].source, "stereo");
  EXPECT_EQ(got.sources[1].id, 9U);
  ASSERT_EQ(message.views.size(), 1U);
  EXPECT_EQ(message.views[0].sensor.theta, 0.5);
  EXPECT_EQ(message.views[0].first_bearing, -1.5F);
  EXPECT_EQ(message.views[0].reach, (std::vector<float>{10.5F, 0.0F, 80.0F}));
}

TEST(TrackConversion, RoundTrip) {
  const Track track = sampleTrack();
  const TrackList back = fromMessage(toMessage(sampleList(), "map"));
  EXPECT_EQ(back.stamp, kStamp);
  ASSERT_EQ(back.tracks.size(), 1U);
  const Track& got = back.tracks[0];
  EXPECT_EQ(got.id, track.id);
  EXPECT_EQ(got.state, track.state);
  EXPECT_EQ(got.covariance, track.covariance);
  EXPECT_EQ(got.mode_probabilities, track.mode_probabilities);
  EXPECT_EQ(got.box.center.position(), track.box.center.position());
  EXPECT_NEAR(got.box.center.heading(), track.box.center.heading(), 1e-12);
  EXPECT_EQ(got.box.length, track.box.length);
  EXPECT_EQ(got.box.width, track.box.width);
  EXPECT_EQ(got.height, track.height);
  EXPECT_EQ(got.yaw_rate, track.yaw_rate);
  EXPECT_EQ(got.heading_variance, track.heading_variance);
  EXPECT_EQ(got.moving, track.moving);
  EXPECT_EQ(got.class_probabilities, track.class_probabilities);
  EXPECT_EQ(got.existence_probability, track.existence_probability);
  EXPECT_EQ(got.age, track.age);
  EXPECT_EQ(got.since_update, track.since_update);
  EXPECT_EQ(got.hits, track.hits);
  EXPECT_EQ(got.sensors, track.sensors);
  ASSERT_EQ(got.history.size(), 2U);
  EXPECT_EQ(got.history[0].stamp, track.history[0].stamp);
  EXPECT_EQ(got.history[0].pose.position(), track.history[0].pose.position());
  EXPECT_EQ(got.history[0].pose.heading(), track.history[0].pose.heading());
  ASSERT_EQ(got.sources.size(), 2U);
  EXPECT_EQ(got.sources[0].source, "lidar");
  EXPECT_EQ(got.sources[0].id, 4U);
  EXPECT_EQ(got.sources[1].id, 9U);
}

TEST(TrackConversion, RoundTripOfViews) {
  const TrackList list = sampleList();
  const TrackList back = fromMessage(toMessage(list, "map"));
  ASSERT_EQ(back.views.size(), 1U);
  const ViewFan& view = list.views[0];
  const ViewFan& got = back.views[0];
  EXPECT_EQ(got.sensor.position(), view.sensor.position());
  EXPECT_EQ(got.sensor.heading(), view.sensor.heading());
  EXPECT_EQ(got.first_bearing, view.first_bearing);
  EXPECT_EQ(got.beam_spacing, view.beam_spacing);
  EXPECT_EQ(got.min_range, view.min_range);
  EXPECT_EQ(got.sure_range, view.sure_range);
  EXPECT_EQ(got.range, view.range);
  EXPECT_EQ(got.by_beams, view.by_beams);
  EXPECT_EQ(got.reach, view.reach);
}

TEST(TrackConversion, ReverseRoundTripIsTheSameMessage) {
  const TrackArray message = toMessage(sampleList(), "map");
  TrackArray again = toMessage(fromMessage(message), "map");
  EXPECT_NEAR(again.tracks.at(0).pose.orientation.z, message.tracks[0].pose.orientation.z, 1e-15);
  again.tracks[0].pose = message.tracks[0].pose;
  EXPECT_EQ(again.tracks, message.tracks);
  EXPECT_EQ(again.views, message.views);
}

TEST(TrackConversion, BadTracksAreKeptAsInvalid) {
  TrackList valid = sampleList();
  valid.tracks[0].covariance(1, 0) = valid.tracks[0].covariance(0, 1);
  const TrackArray good = toMessage(valid, "map");
  ASSERT_TRUE(isValid(fromMessage(good).tracks.at(0)));
  const std::vector<std::function<void(TrackMessage&)>> faults = {
      [](TrackMessage& track) { track.mode_probabilities.pop_back(); },
      [](TrackMessage& track) { track.mode_probabilities.clear(); },
      [](TrackMessage& track) { track.class_probabilities.push_back(0.0F); },
      [](TrackMessage& track) { track.class_probabilities.resize(100000); },
      [](TrackMessage& track) { track.pose.position.x = kNan; },
      [](TrackMessage& track) { track.pose.orientation.w = kNan; },
      [](TrackMessage& track) { track.covariance[7] = -1.0; },
      [](TrackMessage& track) { track.covariance.fill(kNan); },
      [](TrackMessage& track) { track.age = ros::Duration(-1.0); },
      [](TrackMessage& track) { track.age = ros::Duration(2147483647, 999999999); },
      [](TrackMessage& track) { track.history[1].pose.theta = kNan; },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    TrackArray message = good;
    faults[i](message.tracks.at(0));
    const TrackList list = fromMessage(message);
    ASSERT_EQ(list.tracks.size(), 1U) << i;
    EXPECT_FALSE(isValid(list.tracks[0])) << i;
  }
}

TEST(TrackConversion, InvalidViewsAreLeftOut) {
  TrackArray message = toMessage(sampleList(), "map");
  const ViewFanMessage good = message.views.at(0);
  message.views.assign(5, good);
  message.views[0].beam_spacing = 0.0F;
  message.views[1].reach[1] = std::numeric_limits<float>::infinity();
  message.views[2].sensor.theta = kNan;
  message.views[3].reach.resize(100000);
  const TrackList list = fromMessage(message);
  ASSERT_EQ(list.views.size(), 1U);
  EXPECT_EQ(list.views[0].reach, sampleList().views[0].reach) << "the one that is left";
}

}  // namespace
}  // namespace datmo::track_conversion_test
