// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <vector>

#include "marker_search.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/display/markers.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo::track_markers_test {
namespace {

using samples::find;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

TrackMessage makeTrack(std::uint32_t id) {
  TrackMessage track;
  track.id = id;
  track.pose = toMessage(Pose2(10.0, 5.0, 0.5));
  track.size.x = 4.0;
  track.size.y = 2.0;
  track.velocity.x = 3.0;
  track.velocity.y = 4.0;
  track.moving = true;
  track.sensors = {"lidar", "stereo"};
  return track;
}

TEST(TrackMarkers, TrackHasBoxArrowAndLabel) {
  TrackArray tracks;
  tracks.header.frame_id = "map";
  tracks.tracks = {makeTrack(7)};
  MarkersOptions options;
  options.arrow_time = 2.0;
  const MarkerArray markers = markersOf(tracks, options);

  const Marker* box = find(markers, "track bodies", 7);
  ASSERT_NE(box, nullptr);
  EXPECT_EQ(box->header.frame_id, "map");
  EXPECT_DOUBLE_EQ(box->scale.x, 4.0);
  EXPECT_DOUBLE_EQ(box->scale.z, options.default_height);

  const Marker* arrow = find(markers, "track velocities", 7);
  ASSERT_NE(arrow, nullptr);
  ASSERT_EQ(arrow->points.size(), 2U);
  EXPECT_DOUBLE_EQ(arrow->points[1].x - arrow->points[0].x, 6.0);
  EXPECT_DOUBLE_EQ(arrow->points[1].y - arrow->points[0].y, 8.0);

  const Marker* label = find(markers, "track labels", 7);
  ASSERT_NE(label, nullptr);
  EXPECT_EQ(label->text, "#7 5.0 m/s");
}

TEST(TrackMarkers, StationaryTracksHaveNoArrowAndNoSpeedAndArePale) {
  TrackArray tracks;
  tracks.tracks = {makeTrack(7), makeTrack(8)};
  tracks.tracks[1].moving = false;
  const MarkerArray markers = markersOf(tracks, MarkersOptions());
  EXPECT_EQ(find(markers, "track velocities", 8), nullptr);
  EXPECT_EQ(find(markers, "track labels", 8)->text, "#8");
  const auto& moving = find(markers, "track bodies", 7)->color;
  const auto& standing = find(markers, "track bodies", 8)->color;
  EXPECT_GT(standing.r, moving.r);
  EXPECT_GT(standing.g, moving.g);
}

TEST(TrackMarkers, ALabelIsClearOfItsBoxSeenFrom45DegreesAbove) {
  TrackArray tracks;
  tracks.tracks = {makeTrack(7)};
  tracks.tracks[0].size.z = 2.5;
  const MarkersOptions options;
  const MarkerArray markers = markersOf(tracks, options);
  const Marker* label = find(markers, "track labels", 7);
  ASSERT_NE(label, nullptr);
  // Seen along the box, its far upper edge is 2 m away from the middle, and at the same height in
  // the image as a point 2 m above the roof's middle.
  EXPECT_DOUBLE_EQ(label->pose.position.z - 0.5 * options.text_height, 2.5 + 2.0);
  EXPECT_DOUBLE_EQ(label->pose.position.y, 5.0);
}

TEST(TrackMarkers, LabelNamesAKnownClass) {
  TrackArray tracks;
  tracks.tracks = {makeTrack(7)};
  tracks.tracks[0].classification = ObjectMessage::CLASS_VEHICLE;
  const MarkerArray markers = markersOf(tracks, MarkersOptions());
  EXPECT_EQ(find(markers, "track labels", 7)->text, "#7 vehicle 5.0 m/s");
}

MarkerArray tracksOfClass(std::uint8_t classification) {
  TrackArray tracks;
  tracks.tracks = {makeTrack(7)};
  tracks.tracks[0].classification = classification;
  tracks.tracks[0].size.z = 1.8;
  return markersOf(tracks, MarkersOptions());
}

TEST(TrackMarkers, ClassesAreShapes) {
  const auto body = [](std::uint8_t classification) {
    return *find(tracksOfClass(classification), "track bodies", 7);
  };
  EXPECT_EQ(body(ObjectMessage::CLASS_UNKNOWN).type, Marker::CUBE);
  EXPECT_EQ(body(ObjectMessage::CLASS_VEHICLE).type, Marker::CUBE);
  EXPECT_EQ(body(ObjectMessage::CLASS_PEDESTRIAN).type, Marker::CYLINDER);
  EXPECT_EQ(body(ObjectMessage::CLASS_CYCLIST).type, Marker::CUBE);
  EXPECT_EQ(body(ObjectMessage::CLASS_POLE).type, Marker::CYLINDER);
  EXPECT_LT(body(ObjectMessage::CLASS_POLE).scale.x, body(ObjectMessage::CLASS_PEDESTRIAN).scale.x);
  EXPECT_LT(body(ObjectMessage::CLASS_CYCLIST).scale.y, body(ObjectMessage::CLASS_VEHICLE).scale.y);
}

TEST(TrackMarkers, PeopleHaveHeadsAndRealisticHeights) {
  for (const std::uint8_t person :
       {ObjectMessage::CLASS_PEDESTRIAN, ObjectMessage::CLASS_CYCLIST}) {
    const MarkerArray markers = tracksOfClass(person);
    const Marker* body = find(markers, "track bodies", 7);
    const Marker* head = find(markers, "track heads", 7);
    ASSERT_NE(head, nullptr);
    EXPECT_EQ(head->type, Marker::SPHERE);
    EXPECT_NEAR(head->pose.position.z + 0.5 * head->scale.z, 1.8, 1e-9);
    EXPECT_NEAR(head->pose.position.z - 0.5 * head->scale.z, body->scale.z, 1e-9);
    EXPECT_NEAR(body->pose.position.z, 0.5 * body->scale.z, 1e-9) << "it stands on the ground";
  }
  EXPECT_EQ(find(tracksOfClass(ObjectMessage::CLASS_VEHICLE), "track heads", 7), nullptr);
}

TEST(TrackMarkers, OutlinesShowTheSensors) {
  const auto colorOf = [](const std::vector<std::string>& sensors) {
    TrackArray tracks;
    tracks.tracks = {makeTrack(7)};
    tracks.tracks[0].sensors = sensors;
    ObjectArray objects;
    objects.objects.resize(1);
    objects.objects[0].sensors = sensors;
    objects.objects[0].dynamic_state = ObjectMessage::STATE_MOVING;
    const Marker track = *find(markersOf(tracks, MarkersOptions()), "track sensors", 7);
    EXPECT_EQ(track.color, find(markersOf(objects, MarkersOptions()), "objects", 0)->color);
    return track.color;
  };
  const auto lidar = colorOf({"lidar"});
  const auto stereo = colorOf({"stereo"});
  const auto both = colorOf({"lidar", "stereo"});
  EXPECT_NE(lidar, stereo);
  EXPECT_NE(lidar, both);
  EXPECT_NE(stereo, both);
  EXPECT_NE(colorOf({"radar"}), lidar);
}

TEST(TrackMarkers, EllipseHoldsThePositionWith95Percent) {
  TrackArray tracks;
  tracks.tracks = {makeTrack(7)};
  // Standard deviations of 2 m along the diagonal, 1 m across it.
  tracks.tracks[0].covariance[0] = tracks.tracks[0].covariance[7] = 2.5;
  tracks.tracks[0].covariance[1] = tracks.tracks[0].covariance[6] = 1.5;
  const MarkerArray markers = markersOf(tracks, MarkersOptions());
  const Marker* ellipse = find(markers, "track covariances", 7);
  ASSERT_NE(ellipse, nullptr);
  const double sigmas = 2.4477;  // exp(-sigmas^2 / 2) = 5 %
  EXPECT_NEAR(ellipse->scale.x, 2.0 * sigmas * 2.0, 1e-3);
  EXPECT_NEAR(ellipse->scale.y, 2.0 * sigmas * 1.0, 1e-3);
  const Pose2 pose = fromMessage(ellipse->pose);
  EXPECT_EQ(pose.position(), Point2(10.0, 5.0));
  EXPECT_NEAR(std::abs(std::sin(pose.heading() - kPi / 4.0)), 0.0, 1e-9);
}

TEST(TrackMarkers, EllipseOfNoSpreadIsStillDrawn) {
  TrackArray tracks;
  tracks.tracks = {makeTrack(7)};
  const MarkersOptions options;
  const MarkerArray markers = markersOf(tracks, options);
  EXPECT_DOUBLE_EQ(find(markers, "track covariances", 7)->scale.y, options.line_width);
}

TEST(TrackMarkers, PathIsTheHistory) {
  TrackArray tracks;
  tracks.tracks = {makeTrack(7), makeTrack(8)};
  tracks.tracks[0].history.resize(3);
  tracks.tracks[0].history[2].pose.x = 10.0;
  tracks.tracks[1].history.resize(1);
  const MarkerArray markers = markersOf(tracks, MarkersOptions());
  const Marker* path = find(markers, "track paths", 7);
  ASSERT_NE(path, nullptr);
  ASSERT_EQ(path->points.size(), 3U);
  EXPECT_DOUBLE_EQ(path->points[2].x, 10.0);
  EXPECT_EQ(find(markers, "track paths", 8), nullptr) << "one point is no line";
}

TEST(TrackMarkers, PathIsOnlyTheLastSeconds) {
  TrackArray tracks;
  tracks.header.stamp = ros::Time(100.0);
  tracks.tracks = {makeTrack(7)};
  for (const double seconds : {90.0, 96.9, 97.1, 98.0, 100.0}) {
    tracks.tracks[0].history.emplace_back();
    tracks.tracks[0].history.back().stamp = ros::Time(seconds);
  }
  MarkersOptions options;
  options.path_time = 3.0;
  const MarkerArray markers = markersOf(tracks, options);
  const Marker* path = find(markers, "track paths", 7);
  ASSERT_NE(path, nullptr);
  EXPECT_EQ(path->points.size(), 3U);
}

TEST(TrackMarkers, ABoxIsTheFainterTheLessLikelyItExists) {
  TrackArray tracks;
  tracks.tracks = {makeTrack(7), makeTrack(8)};
  tracks.tracks[0].existence_probability = 0.2F;
  tracks.tracks[1].existence_probability = 1.0F;
  const MarkerArray markers = markersOf(tracks, MarkersOptions());
  EXPECT_LT(find(markers, "track bodies", 7)->color.a, find(markers, "track bodies", 8)->color.a);
  EXPECT_GT(find(markers, "track bodies", 7)->color.a, 0.0F);
  EXPECT_FLOAT_EQ(find(markers, "track labels", 7)->color.a, 1.0F);
}

TEST(StaleMarkers, MarkersNotDrawnAgainAreDeletedOnce) {
  TrackArray both;
  both.tracks = {makeTrack(1), makeTrack(2)};
  TrackArray one;
  one.tracks = {makeTrack(2)};
  StaleMarkers stale;
  MarkerArray first = markersOf(both, MarkersOptions());
  const std::size_t drawn = first.markers.size();
  stale.replace("tracks", first);
  EXPECT_EQ(first.markers.size(), drawn);
  const std::size_t of_one = drawn / 2;

  MarkerArray second = markersOf(one, MarkersOptions());
  stale.replace("tracks", second);
  ASSERT_EQ(second.markers.size(), 2 * of_one);
  const Marker* gone = find(second, "track labels", 1);
  ASSERT_NE(gone, nullptr);
  EXPECT_EQ(gone->action, Marker::DELETE);

  MarkerArray third = markersOf(one, MarkersOptions());
  stale.replace("tracks", third);
  EXPECT_EQ(third.markers.size(), of_one);
}

TEST(StaleMarkers, SourcesDoNotDeleteEachOther) {
  TrackArray tracks;
  tracks.tracks = {makeTrack(1)};
  StaleMarkers stale;
  MarkerArray drawn = markersOf(tracks, MarkersOptions());
  stale.replace("tracks", drawn);
  MarkerArray nothing;
  stale.replace("objects", nothing);
  EXPECT_TRUE(nothing.markers.empty());
}

TEST(TrackMarkers, ClassesHaveColors) {
  const auto color = [](std::uint8_t classification) {
    const MarkerArray markers = tracksOfClass(classification);
    const Marker* body = find(markers, "track bodies", 7);
    return body == nullptr ? std_msgs::ColorRGBA() : body->color;
  };
  const std::vector<std::uint8_t> classes = {
      ObjectMessage::CLASS_UNKNOWN, ObjectMessage::CLASS_VEHICLE, ObjectMessage::CLASS_PEDESTRIAN,
      ObjectMessage::CLASS_CYCLIST, ObjectMessage::CLASS_POLE};
  for (std::size_t i = 0; i < classes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NE(color(classes[i]), color(classes[j]));
    }
  }
}

}  // namespace
}  // namespace datmo::track_markers_test
