// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/markers.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "marker_search.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo::markers_test {
namespace {

using samples::find;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

TEST(Markers, ObjectsNotSeenMovingArePaleInTheColorOfTheirClass) {
  ObjectArray objects;
  objects.objects.resize(2);
  objects.objects[1].dynamic_state = ObjectMessage::STATE_MOVING;
  objects.objects[1].classification = ObjectMessage::CLASS_PEDESTRIAN;
  const MarkerArray markers = markersOf(objects, MarkersOptions());
  const Marker* still = find(markers, "objects", 0);
  const Marker* moving = find(markers, "objects", 1);
  ASSERT_NE(still, nullptr);
  ASSERT_NE(moving, nullptr);
  EXPECT_LT(still->color.a, moving->color.a);
  EXPECT_EQ(find(markers, "object bodies", 0), nullptr);
  EXPECT_NE(find(markers, "object bodies", 1), nullptr);
  EXPECT_NE(find(markers, "object heads", 1), nullptr);
}

TEST(Markers, VehicleHasTheConfiguredSizeAndMovesWithItsFrame) {
  std_msgs::Header scan;
  scan.frame_id = "base_link";
  scan.stamp = ros::Time(5.0);
  const MarkerArray markers = vehicleMarkers(scan, {4.0, 1.8, 1.0, 1.5});
  const Marker* body = find(markers, "vehicle", 0);
  ASSERT_NE(body, nullptr);
  EXPECT_TRUE(body->frame_locked);
  EXPECT_EQ(body->header.frame_id, "base_link");
  EXPECT_TRUE(body->header.stamp.isZero()) << "tf may not know the scan's time yet";
  EXPECT_DOUBLE_EQ(body->pose.position.x, 1.0);
  EXPECT_DOUBLE_EQ(body->scale.x, 4.0);
  EXPECT_DOUBLE_EQ(body->scale.y, 1.8);
  double top = 0.0;
  for (const Marker& part : markers.markers) {
    top = std::max(top, part.pose.position.z + 0.5 * part.scale.z);
  }
  EXPECT_DOUBLE_EQ(top, 1.5);
}

TEST(Markers, ScanPointsAreColoredByStateInTheMap) {
  LabeledScanMessage scan;
  scan.header.frame_id = "base_link";
  scan.map_frame = "map";
  scan.pose.pose = toMessage(Pose2(1.0, 2.0, 0.0));
  scan.points.resize(2);
  scan.points[0].state = ScanPointMessage::STATIC;
  scan.points[1].state = ScanPointMessage::MOVING;
  const MarkerArray markers = markersOf(scan, MarkersOptions());
  ASSERT_EQ(markers.markers.size(), 1U);
  const Marker& points = markers.markers[0];
  EXPECT_EQ(points.header.frame_id, "map");
  EXPECT_DOUBLE_EQ(points.pose.position.x, 1.0);
  ASSERT_EQ(points.colors.size(), 2U);
  EXPECT_GT(points.colors[0].b, points.colors[0].r);
  EXPECT_GT(points.colors[1].r, points.colors[1].b);
}

TEST(Markers, ScanWithoutPointsDrawsNothing) {
  EXPECT_TRUE(markersOf(LabeledScanMessage(), MarkersOptions()).markers.empty());
}

TEST(Markers, BoxSeenAsAPointIsDrawnInLeastSize) {
  ObjectArray objects;
  objects.objects.resize(1);
  const MarkersOptions options;
  const MarkerArray markers = markersOf(objects, options);
  ASSERT_EQ(markers.markers.size(), 1U);
  EXPECT_DOUBLE_EQ(markers.markers[0].points[0].x, 0.5 * options.min_size);
}

TEST(Markers, OnlyMovingTruthIsDrawn) {
  TrueObjectArray truth;
  truth.objects.resize(2);
  truth.objects[1].id = 9;
  truth.objects[1].moving = true;
  const MarkerArray markers = markersOf(truth, MarkersOptions());
  ASSERT_EQ(markers.markers.size(), 1U);
  EXPECT_EQ(markers.markers[0].id, 9);
}

TEST(Markers, TruthIsDashed) {
  TrueObjectArray truth;
  truth.objects.resize(1);
  truth.objects[0].moving = true;
  truth.objects[0].pose.orientation.w = 1.0;
  truth.objects[0].size.x = 4.0;
  truth.objects[0].size.y = 2.0;
  const MarkersOptions options;
  const Marker marker = markersOf(truth, options).markers[0];
  EXPECT_EQ(marker.type, Marker::LINE_LIST);
  EXPECT_LT(marker.scale.x, options.line_width);
  // Dashes of 0.4 m begin every 0.8 m: 5 along 4 m, 3 along 2 m.
  ASSERT_EQ(marker.points.size(), 2U * (5 + 3 + 5 + 3));
  EXPECT_DOUBLE_EQ(marker.points[0].x, 2.0);
  EXPECT_DOUBLE_EQ(marker.points[1].x, 1.6);
}

TEST(Markers, ObjectsArePlacedWhereTheScanWasSeenFrom) {
  LabeledScanMessage scan;
  scan.map_frame = "map";
  scan.pose.pose = toMessage(Pose2(100.0, 50.0, kPi / 2.0));
  ObjectArray objects;
  objects.header.frame_id = "base_link";
  objects.objects.resize(1);
  objects.objects[0].pose = toMessage(Pose2(10.0, 0.0, 0.25));
  MarkerArray markers = markersOf(objects, MarkersOptions());
  transformToMap(scan, markers);
  EXPECT_EQ(markers.markers[0].header.frame_id, "map");
  const Pose2 pose = fromMessage(markers.markers[0].pose);
  EXPECT_NEAR(pose.x(), 100.0, 1e-9);
  EXPECT_NEAR(pose.y(), 60.0, 1e-9);
  EXPECT_NEAR(pose.heading(), kPi / 2.0 + 0.25, 1e-9);
}

TEST(Markers, PoseThatIsNotFiniteIsRefused) {
  LabeledScanMessage scan;
  scan.pose.pose = toMessage(Pose2());
  scan.pose.pose.position.x = std::nan("");
  MarkerArray markers;
  EXPECT_THROW(transformToMap(scan, markers), InputError);
}

}  // namespace
}  // namespace datmo::markers_test
