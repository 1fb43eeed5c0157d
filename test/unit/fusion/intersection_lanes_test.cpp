// SPDX-License-Identifier: BSD-3-Clause
// The lanes of an intersection in a plane, and positions on them.
#include "datmo_fusion/fusion/earth/intersection_lanes.h"

#include "fusion/signal_messages.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo {
namespace {

LocalPlane plane() {
  GeodeticPosition datum;
  datum.latitude = degrees(45.19);
  datum.longitude = degrees(5.72);
  return LocalPlane(datum);
}

TEST(ApproachLanes, NodesAreStepsFromTheReferencePoint) {
  const ApproachLanes found = approachLanes(samples::mapem().intersections[0], plane());
  EXPECT_EQ(found.left_out, 0U);
  ASSERT_EQ(found.lanes.size(), 2U);
  const ApproachLane& lane = found.lanes[0];
  EXPECT_EQ(lane.id, 5);
  ASSERT_EQ(lane.points.size(), 3U);
  EXPECT_NEAR((lane.points[0] - Point2(5.0, -2.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((lane.points[1] - Point2(25.0, -2.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((lane.points[2] - Point2(325.0, -92.0)).norm(), 0.0, 1e-6);
  EXPECT_EQ(lane.width, 3.5);
  EXPECT_EQ(lane.groups, std::vector<std::int64_t>{3});
  EXPECT_NEAR((found.lanes[1].points[1] - Point2(25.0, 33.0)).norm(), 0.0, 1e-6);
}

TEST(ApproachLanes, APositionOnTheEarthIsANodeToo) {
  MapIntersection intersection = samples::mapem().intersections[0];
  intersection.lanes.resize(1);
  intersection.lanes[0].nodes = {{true, 57200000, 451900000}, {true, 57200000, 451910000}};
  const ApproachLanes found = approachLanes(intersection, plane());
  ASSERT_EQ(found.lanes.size(), 1U);
  // A thousandth of a degree of latitude, at 111.13 km a degree there.
  EXPECT_NEAR(found.lanes[0].points[1].y(), 111.13, 0.1);
}

TEST(ApproachLanes, NonVehicleAndUnusableLanesAreLeftOut) {
  MapIntersection intersection = samples::mapem().intersections[0];
  intersection.lanes[0].direction = MapLane::kEgress;
  intersection.lanes[1].computed->is_changed = true;
  ApproachLanes found = approachLanes(intersection, plane());
  EXPECT_TRUE(found.lanes.empty());
  EXPECT_EQ(found.left_out, 1U);
  intersection = samples::mapem().intersections[0];
  intersection.lanes[0].type = 2;  // bicycles
  intersection.lanes[1].computed->reference = 77;
  found = approachLanes(intersection, plane());
  EXPECT_TRUE(found.lanes.empty());
  EXPECT_EQ(found.left_out, 1U);
  intersection.latitude = ItsPosition::kNoLatitude;
  EXPECT_EQ(samples::refusalOf([&] { approachLanes(intersection, plane()); }), "no_position");
  intersection = samples::mapem().intersections[0];
  intersection.lanes[0].nodes = {{false, 0, 0}, {false, 0, 0}};  // one point
  EXPECT_EQ(approachLanes(intersection, plane()).left_out, 2U);
}

TEST(PositionOnLane, DistancesAreAlongTheLane) {
  ApproachLane lane;
  lane.points = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 20.0}};
  LanePosition position = positionOn(lane, {4.0, 1.0});
  EXPECT_NEAR(position.distance, 4.0, 1e-9);
  EXPECT_NEAR(position.lateral, 1.0, 1e-9);
  EXPECT_NEAR(std::abs(position.heading), kPi, 1e-9);  // to the west
  position = positionOn(lane, {12.0, 15.0});
  EXPECT_NEAR(position.distance, 25.0, 1e-9);
  EXPECT_NEAR(position.lateral, 2.0, 1e-9);
  EXPECT_NEAR(position.heading, -kQuarterTurn, 1e-9);
  EXPECT_EQ(position.outside, 0.0);
  position = positionOn(lane, {-3.0, 0.5});
  EXPECT_NEAR(position.distance, -3.0, 1e-9);
  EXPECT_NEAR(position.lateral, 0.5, 1e-9);
  position = positionOn(lane, {10.0, 26.0});  // before its start
  EXPECT_NEAR(position.distance, 36.0, 1e-9);
  EXPECT_NEAR(position.lateral, 0.0, 1e-9);
  EXPECT_NEAR(position.outside, 6.0, 1e-9);
}

}  // namespace
}  // namespace datmo
