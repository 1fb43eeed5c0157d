// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/road_network.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace datmo::simulator::road_network_test {
namespace {

/// A road of 10 m width along x, and one of 8 m along y that crosses it at the origin.
RoadNetwork cross() {
  return {{{"main", Path({{-50.0, 0.0}, {50.0, 0.0}}, 5.0), 10.0, 4.0, 3.0, 6.0, 0.12},
           {"side", Path({{0.0, -50.0}, {0.0, 50.0}}, 5.0), 8.0, 4.0, 0.0, 6.0, 0.12}},
          {{0, 20.0, 4.0}}};
}

TEST(RoadNetwork, SingleRoadHasTwoStraightCurbs) {
  const RoadNetwork network(
      {{"main", Path({{0.0, 0.0}, {50.0, 0.0}}, 5.0), 10.0, 4.0, 0.0, 6.0, 0.12}}, {});
  ASSERT_EQ(network.curbs().size(), 2U);
  const Polyline& left = network.curbs()[0];
  ASSERT_EQ(left.size(), 2U);
  EXPECT_EQ(left[0], Point2(0.0, 5.0));
  EXPECT_EQ(left[1], Point2(50.0, 5.0));
  EXPECT_FALSE(network.atIntersection({25.0, 0.0}));
}

TEST(RoadNetwork, CrossingRoadsLeaveTheJunctionOpen) {
  const RoadNetwork network = cross();
  // Two curbs of two roads in two pieces each, and four corners.
  EXPECT_EQ(network.curbs().size(), 12U);
  for (const Polyline& curb : network.curbs()) {
    for (const Point2& point : curb) {
      const bool on_main = std::abs(point.y()) < 5.0 - 1e-6;
      const bool on_side = std::abs(point.x()) < 4.0 - 1e-6;
      EXPECT_FALSE(on_main || on_side) << point.transpose();
    }
  }
}

TEST(RoadNetwork, CornersJoinTheCurbs) {
  const RoadNetwork network = cross();
  for (std::size_t i = 8; i < 12; ++i) {
    const Polyline& corner = network.curbs()[i];
    for (const Point2& end : {corner.front(), corner.back()}) {
      const auto touches = [&end](const Polyline& curb) {
        return curb.front() == end || curb.back() == end;
      };
      EXPECT_EQ(std::count_if(network.curbs().begin(), network.curbs().begin() + 8, touches), 1);
    }
  }
}

TEST(RoadNetwork, RoadThatEndsInAnotherOpensOneSideOnly) {
  const RoadNetwork network(
      {{"main", Path({{-50.0, 0.0}, {50.0, 0.0}}, 5.0), 10.0, 4.0, 0.0, 6.0, 0.12},
       {"side", Path({{0.0, -50.0}, {0.0, 0.0}}, 5.0), 8.0, 4.0, 0.0, 6.0, 0.12}},
      {});
  const auto whole = [](const Polyline& curb) {
    return curb.front() == Point2(-50.0, 5.0) && curb.back() == Point2(50.0, 5.0);
  };
  EXPECT_EQ(std::count_if(network.curbs().begin(), network.curbs().end(), whole), 1);
  // Left one in one piece, right one in two; two of the side road; two corners.
  EXPECT_EQ(network.curbs().size(), 7U);
}

TEST(RoadNetwork, KnowsItsIntersection) {
  const RoadNetwork network = cross();
  EXPECT_TRUE(network.atIntersection({0.0, 0.0}));
  EXPECT_TRUE(network.atIntersection({7.5, 1.0}));
  EXPECT_FALSE(network.atIntersection({8.5, 1.0}));
  EXPECT_FALSE(network.atIntersection({20.0, 20.0}));
}

TEST(RoadNetwork, PaintsDashesOutsideTheJunctionAndZebraStripes) {
  const std::vector<Box2> paint = cross().paint();
  const auto is_dash = [](const Box2& box) { return box.width < 0.2; };
  // 10 m of stripes, half paint and half gap; 11 dashes, less one on the zebra crossing and one in
  // the junction.
  EXPECT_EQ(std::count_if(paint.begin(), paint.end(), is_dash), 9);
  EXPECT_EQ(paint.size(), 9U + 10U);
  for (const Box2& box : paint) {
    EXPECT_GT(std::abs(box.center.x()), 8.0);
    EXPECT_LT(std::abs(box.center.y()), 5.0);
  }
}

TEST(RoadNetwork, PositionsBesideARoadFollowItsDirection) {
  const Pose2 position = cross().beside(1, 10.0, 4.0);
  EXPECT_NEAR(position.x(), -4.0, 1e-12);
  EXPECT_NEAR(position.y(), -40.0, 1e-12);
  EXPECT_NEAR(position.heading(), kPi / 2.0, 1e-12);
}

}  // namespace
}  // namespace datmo::simulator::road_network_test
