// SPDX-License-Identifier: BSD-3-Clause
// Drawing of risks and of the tracks beside them: markers, the driver's image, the tracks' style.
#include <cmath>
#include <limits>

#include "marker_search.h"
#include "track_fusion_sample.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/display/driver_view.h"
#include "datmo_fusion/ros/display/risk_style.h"
#include "datmo_fusion/ros/display/track_style.h"

namespace datmo::risk_display_test {
namespace {

using samples::find;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

geometry_msgs::Pose2D pose2d(double x, double y, double heading) {
  geometry_msgs::Pose2D pose;
  pose.x = x;
  pose.y = y;
  pose.theta = heading;
  return pose;
}

/// The host drives north from (10, 0) at 10 m/s; track 7 is struck at (10, 20) in 1.8 s.
RiskArray northward() {
  RiskArray risks;
  risks.header.frame_id = "map";
  risks.level = RiskArray::LEVEL_WARNING;
  risks.cause = 7;
  risks.reason = "pedestrian 7 at the front";
  risks.host_length = 4.0F;
  risks.host_width = 2.0F;
  risks.host_path_step = 1.0F;
  for (int i = 0; i <= 4; ++i) {
    risks.host_path.push_back(pose2d(10.0, 10.0 * i, 0.5 * kPi));
  }
  RiskMessage risk;
  risk.id = 7;
  risk.contact_probability[3] = 0.8F;
  risk.median_ttc = 1.8F;
  risk.time_to_brake = 0.6F;
  risk.contact.x = 10.0;
  risk.contact.y = 20.0;
  risks.risks = {risk};
  return risks;
}

TrackArray oneTrack() {
  TrackArray tracks;
  tracks.header.frame_id = "map";
  TrackMessage track;
  track.id = 7;
  track.pose = toMessage(Pose2(13.0, 20.0, kPi));
  track.size.x = 0.6;
  track.size.y = 0.5;
  track.classification = ObjectMessage::CLASS_PEDESTRIAN;
  track.velocity.x = -2.0;
  track.moving = true;
  track.existence_probability = 0.9F;
  tracks.tracks = {track};
  return tracks;
}

TEST(RiskMarkers, TheTubeIsTheGroundBeforeTheBumper) {
  const MarkerArray markers = markersOf(northward(), RiskStyle());
  const Marker* tube = find(markers, "host tube", 0);
  ASSERT_NE(tube, nullptr);
  ASSERT_EQ(tube->points.size(), 4U * 6U);
  EXPECT_EQ(tube->colors.size(), tube->points.size());
  EXPECT_NEAR(tube->points[0].x, 11.0, 1e-9) << "right of a vehicle that goes north";
  EXPECT_NEAR(tube->points[0].y, 2.0, 1e-9);
  EXPECT_GT(tube->colors.front().r, tube->colors.back().r) << "red is now";
  EXPECT_LT(tube->colors.front().g, tube->colors.back().g);
}

TEST(RiskMarkers, AContactIsADiscWithItsTime) {
  const MarkerArray markers = markersOf(northward(), RiskStyle());
  const Marker* disc = find(markers, "contacts", 7);
  ASSERT_NE(disc, nullptr);
  EXPECT_DOUBLE_EQ(disc->pose.position.y, 20.0);
  const Marker* label = find(markers, "contact labels", 7);
  ASSERT_NE(label, nullptr);
  EXPECT_EQ(label->text, "1.8 s 80 % 0 m/s");
  const Marker* reason = find(markers, "risk level", 0);
  ASSERT_NE(reason, nullptr);
  EXPECT_EQ(reason->text, "pedestrian 7 at the front");
}

TEST(RiskMarkers, TheReasonIsInTwoDarkLines) {
  RiskArray risks = northward();
  risks.reason = "vehicle 2 at the front (86 %): brake within 2.4 s";
  const MarkerArray markers = markersOf(risks, RiskStyle());
  const Marker* reason = find(markers, "risk level", 0);
  ASSERT_NE(reason, nullptr);
  EXPECT_EQ(reason->text, "vehicle 2 at the front (86 %):\nbrake within 2.4 s");
  EXPECT_LT(reason->color.r, 0.5F) << "to be read on a white map";
}

TEST(RiskMarkers, UnlikelyContactsAndNoLevelAreNotDrawn) {
  RiskArray risks = northward();
  risks.level = RiskArray::LEVEL_NONE;
  risks.risks[0].contact_probability[3] = 0.05F;
  MarkerArray markers = markersOf(risks, RiskStyle());
  EXPECT_EQ(find(markers, "contacts", 7), nullptr);
  EXPECT_EQ(find(markers, "risk level", 0), nullptr);
  risks.host_path.clear();
  EXPECT_TRUE(markersOf(risks, RiskStyle()).markers.empty());
  risks.risks[0].median_ttc = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(markersOf(risks, {0.0, 1.0}).markers.empty()) << "no contact, no point of it";
}

TEST(DriverView, IsInTheFrameOfTheHost) {
  const TrackArray tracks = oneTrack();
  const DriverView view = driverViewOf(northward(), &tracks);
  EXPECT_EQ(view.level, RiskArray::LEVEL_WARNING);
  ASSERT_EQ(view.icons.size(), 1U);
  EXPECT_NEAR(view.icons[0].pose.x(), 20.0, 1e-9) << "ahead";
  EXPECT_NEAR(view.icons[0].pose.y(), -3.0, 1e-9) << "to the right";
  EXPECT_NEAR(view.icons[0].pose.heading(), 0.5 * kPi, 1e-9) << "from right to left";
  EXPECT_TRUE(view.icons[0].is_cause);
  EXPECT_NEAR(view.icons[0].probability, 0.8, 1e-6);
  ASSERT_TRUE(view.contact);
  EXPECT_NEAR(view.contact->x(), 20.0, 1e-9);
  EXPECT_NEAR(*view.ttc, 1.8, 1e-6);
  EXPECT_NEAR(*view.time_to_brake, 0.6, 1e-6);
  ASSERT_EQ(view.path.size(), 5U);
  EXPECT_NEAR(view.path[4].x(), 40.0, 1e-9);
}

TEST(DriverView, LevelNoneHasNoCause) {
  RiskArray risks = northward();
  risks.level = RiskArray::LEVEL_NONE;
  const TrackArray tracks = oneTrack();
  const DriverView view = driverViewOf(risks, &tracks);
  EXPECT_FALSE(view.ttc);
  EXPECT_FALSE(view.contact);
  EXPECT_FALSE(view.icons.at(0).is_cause);
}

TEST(DriverView, IsDrawnWithoutTracksAndWithoutPath) {
  TrackArray elsewhere = oneTrack();
  elsewhere.header.frame_id = "odom";
  EXPECT_TRUE(driverViewOf(northward(), nullptr).icons.empty());
  EXPECT_TRUE(driverViewOf(northward(), &elsewhere).icons.empty());
  EXPECT_EQ(driverViewOf(RiskArray(), nullptr).level, RiskArray::LEVEL_NONE);
  RiskArray risks = northward();
  TrackArray broken = oneTrack();
  broken.tracks[0].pose.position.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(driverViewOf(risks, &broken).icons.empty());
  risks.host_path[0].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(driverViewOf(risks, nullptr).path.empty());
}

TEST(DriverView, ThePathEndsBeforeANonFinitePose) {
  for (const double number :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    RiskArray at_x = northward();
    at_x.host_path[2].x = number;
    EXPECT_EQ(driverViewOf(at_x, nullptr).path.size(), 2U) << number;
    RiskArray at_heading = northward();
    at_heading.host_path[3].theta = number;
    EXPECT_EQ(driverViewOf(at_heading, nullptr).path.size(), 3U) << number;
  }
}

TEST(DriverView, ARoadUserOfNonFiniteSizeIsNotDrawn) {
  TrackArray tracks = oneTrack();
  tracks.tracks[0].size.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(driverViewOf(northward(), &tracks).icons.empty());
}

/// Black without a body.
std_msgs::ColorRGBA bodyColor(const MarkerArray& markers, int id) {
  const Marker* body = find(markers, "track bodies", id);
  return body ? body->color : std_msgs::ColorRGBA();
}

TEST(TrackStyle, ColorsShowTheChosenProperty) {
  TrackArray tracks = oneTrack();
  tracks.tracks.push_back(tracks.tracks[0]);
  tracks.tracks[1].id = 8;
  tracks.tracks[1].velocity.x = -14.0;
  TrackStyle style;
  const auto bodies = [&] {
    const MarkerArray markers = markersOf(tracks, style);
    return std::make_pair(bodyColor(markers, 7), bodyColor(markers, 8));
  };
  EXPECT_EQ(bodies().first, bodies().second) << "one class, one color";
  style.color_by = TrackColor::kId;
  EXPECT_NE(bodies().first, bodies().second);
  style.color_by = TrackColor::kSpeed;
  EXPECT_GT(bodies().first.b, bodies().second.b) << "the slow one is blue";
  EXPECT_LT(bodies().first.r, bodies().second.r) << "the fast one red";
  style.color_by = TrackColor::kSensors;
  EXPECT_EQ(bodies().first, bodies().second);
}

TEST(TrackStyle, UncertainTracksFadeAndAreLeftOut) {
  TrackStyle style;
  const float faded = bodyColor(markersOf(oneTrack(), style), 7).a;
  style.fade_by_existence = false;
  EXPECT_GT(bodyColor(markersOf(oneTrack(), style), 7).a, faded);
  style.min_existence = 0.95;
  EXPECT_TRUE(markersOf(oneTrack(), style).markers.empty());
}

TEST(Predictions, AreOneLineForEachLikelyMode) {
  TrackList list;
  Track track = carTrack("lidar", 7, 100.0);
  track.state << 0.0, 0.0, 10.0, 0.0, 0.0, 0.0;
  track.covariance = 0.01 * TrackCovariance::Identity();
  track.box.center = Pose2(0.0, 0.0, 0.0);
  track.existence_probability = 1.0;
  track.mode_probabilities = {0.6, 0.0, 0.4, 0.0, 0.0};
  list.tracks = {track};
  TrackStyle style;
  style.prediction_time = 2.0;
  const MarkerArray markers = predictionsOf(toMessage(list, "map"), style);
  ASSERT_EQ(markers.markers.size(), 2U);
  const Marker& straight = markers.markers[0];
  EXPECT_NEAR(straight.points.back().x, 20.0, 1e-6);
  EXPECT_NEAR(straight.points.back().y, 0.0, 1e-6);
  EXPECT_GT(markers.markers[1].points.back().y, 0.5) << "a left turn";
  EXPECT_GT(straight.color.a, markers.markers[1].color.a);
  style.min_mode = 0.5;
  EXPECT_EQ(predictionsOf(toMessage(list, "map"), style).markers.size(), 1U);
  list.tracks[0].covariance.setZero();
  EXPECT_TRUE(predictionsOf(toMessage(list, "map"), style).markers.empty()) << "not valid";
}

}  // namespace
}  // namespace datmo::risk_display_test
