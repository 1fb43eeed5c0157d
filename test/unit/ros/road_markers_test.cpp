// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "marker_search.h"
#include "road_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/road_conversion.h"
#include "datmo_fusion/ros/display/markers.h"

namespace datmo::road_markers_test {
namespace {

using samples::find;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

MarkerArray markersOfRoad(const RoadModel& road) {
  return markersOf(toMessage(road, "map"), MarkersOptions());
}

/// Returns the marker, or an empty one and a failure.
Marker get(const MarkerArray& markers, const std::string& name, int id) {
  const Marker* found = find(markers, name, id);
  EXPECT_NE(found, nullptr) << name << ' ' << id;
  return found == nullptr ? Marker() : *found;
}

LabeledScanMessage scanFrom(const Pose2& pose) {
  LabeledScanMessage scan;
  scan.map_frame = "map";
  scan.pose.pose = toMessage(pose);
  return scan;
}

TEST(RoadMarkers, EachStretchIsALineInTheColorOfItsSide) {
  const MarkerArray markers = markersOfRoad(samples::straightRoad());
  const Marker left = get(markers, "road borders", 0);
  const Marker right = get(markers, "road borders", 1);
  EXPECT_EQ(left.header.frame_id, "map");
  EXPECT_EQ(left.type, Marker::LINE_STRIP);
  ASSERT_EQ(left.points.size(), 3U);
  EXPECT_EQ(left.points[1].x, 10.0);
  EXPECT_EQ(left.points[1].y, 3.0);
  EXPECT_NE(left.color.b, right.color.b);
}

TEST(RoadMarkers, LikelyBordersAreWideAndLessTransparent) {
  const MarkerArray markers = markersOfRoad(samples::straightRoad());  // 0.75 and 0.5
  const Marker likely = get(markers, "road borders", 0);
  const Marker doubtful = get(markers, "road borders", 1);
  EXPECT_GT(likely.scale.x, doubtful.scale.x);
  EXPECT_GT(likely.color.a, doubtful.color.a);
}

TEST(RoadMarkers, SideStreetsAreDark) {
  RoadModel road = samples::straightRoad();
  const float own = get(markersOfRoad(road), "road borders", 0).color.r;
  road.borders[0].side_street = true;
  EXPECT_LT(get(markersOfRoad(road), "road borders", 0).color.r, own);
}

TEST(RoadMarkers, TheBandIsTwoStandardDeviationsToEachSide) {
  const MarkerArray markers = markersOfRoad(samples::straightRoad());
  const Marker band = get(markers, "road border sigmas", 0);
  EXPECT_EQ(band.type, Marker::LINE_LIST);
  ASSERT_EQ(band.points.size(), 8U);  // two pieces, each on both sides
  EXPECT_DOUBLE_EQ(band.points[0].y, 3.25);
  EXPECT_DOUBLE_EQ(band.points[1].y, 3.5);
  EXPECT_DOUBLE_EQ(band.points[2].y, 2.75);
  EXPECT_DOUBLE_EQ(band.points[3].y, 2.5);
  EXPECT_DOUBLE_EQ(band.points[5].y, 4.0);
  EXPECT_DOUBLE_EQ(band.points[7].x, 20.0);
}

TEST(RoadMarkers, PointsOnTopOfEachOtherHaveNoBandButNumbers) {
  RoadModel road = samples::straightRoad();
  road.borders[1].points[1] = road.borders[1].points[0];
  const MarkerArray markers = markersOfRoad(road);
  const Marker band = get(markers, "road border sigmas", 1);
  EXPECT_DOUBLE_EQ(band.points.at(0).y, -4.0);
}

TEST(RoadMarkers, BadBordersAreNotDrawn) {
  RoadBorders message = toMessage(samples::straightRoad(), "map");
  message.borders[0].points[0].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(samples::reasonOf([&] { markersOf(message, MarkersOptions()); }), "bad_border");
}

TEST(RoadMarkers, AnIntersectionIsShownAtTheVehicle) {
  RoadModel road = samples::straightRoad();
  road.intersection_probability = 0.93;
  MarkerArray markers;
  addIntersection(toMessage(road, "map"), scanFrom({7.0, 8.0, 0.3}), MarkersOptions(), markers);
  EXPECT_TRUE(markers.markers.empty());
  road.at_intersection = true;
  addIntersection(toMessage(road, "map"), scanFrom({7.0, 8.0, 0.3}), MarkersOptions(), markers);
  const Marker text = get(markers, "intersection", 0);
  EXPECT_EQ(text.text, "intersection 0.93");
  EXPECT_EQ(text.header.frame_id, "map");
  EXPECT_DOUBLE_EQ(text.pose.position.x, 7.0);
  EXPECT_DOUBLE_EQ(text.pose.position.y, 8.0);
}

TEST(RoadMarkers, DroppedObjectsAreGrayAndHaveAReason) {
  DroppedObjects dropped;
  dropped.header.frame_id = "base_link";
  dropped.objects.resize(2);
  dropped.objects[0].object.pose = toMessage(Pose2(5.0, 6.0, 0.0));
  dropped.objects[0].object.size.x = 4.0;
  dropped.objects[0].beyond = 0.3F;
  dropped.objects[1].reason = DroppedObjectMessage::BEYOND_BORDER;
  dropped.objects[1].beyond = 2.0F;
  const MarkerArray markers = markersOf(dropped, MarkersOptions());
  const Marker outline = get(markers, "dropped objects", 0);
  EXPECT_EQ(outline.header.frame_id, "base_link");
  EXPECT_EQ(outline.pose.position.x, 5.0);
  EXPECT_EQ(outline.points.at(0).x, 2.0);
  EXPECT_EQ(outline.color.r, outline.color.g);
  EXPECT_EQ(outline.color.r, outline.color.b);
  EXPECT_EQ(get(markers, "dropped labels", 0).text, "on border 0.3 m");
  EXPECT_EQ(get(markers, "dropped labels", 1).text, "beyond border 2.0 m");
}

TEST(RoadMarkers, ABorderThatIsGoneIsDeleted) {
  StaleMarkers stale;
  MarkerArray first = markersOfRoad(samples::straightRoad());
  stale.replace("road_borders", first);
  RoadModel road = samples::straightRoad();
  road.borders.pop_back();
  MarkerArray second = markersOfRoad(road);
  stale.replace("road_borders", second);
  for (const char* name : {"road borders", "road border sigmas"}) {
    EXPECT_EQ(get(second, name, 0).action, Marker::ADD);
    EXPECT_EQ(get(second, name, 1).action, Marker::DELETE);
  }
}

}  // namespace
}  // namespace datmo::road_markers_test
