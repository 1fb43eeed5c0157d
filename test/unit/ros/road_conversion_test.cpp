// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/road_conversion.h"

#include <cmath>
#include <functional>
#include <limits>

#include "road_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo::road_conversion_test {
namespace {

using samples::reasonOf;
using samples::straightRoad;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Returns the reason for which the straight road's message is refused after `spoil`; empty if it
/// is not.
std::string reasonAfter(const std::function<void(RoadBorders&)>& spoil) {
  RoadBorders message = toMessage(straightRoad(), "map");
  spoil(message);
  return reasonOf([&] { fromMessage(message); });
}

/// The same for the first border of it.
std::string reasonAfterBorder(const std::function<void(RoadBorderMessage&)>& spoil) {
  return reasonAfter([&](RoadBorders& message) { spoil(message.borders.at(0)); });
}

/// Returns the reason for which a road is not published.
std::string reasonToPublish(const std::function<void(RoadModel&)>& spoil) {
  RoadModel road = straightRoad();
  spoil(road);
  return reasonOf([&] { toMessage(road, "map"); });
}

TEST(RoadConversion, RoundTrip) {
  RoadModel road = straightRoad();
  road.at_intersection = true;
  road.borders[1].side_street = true;
  const RoadBorders message = toMessage(road, "map");
  EXPECT_EQ(message.header.frame_id, "map");
  const RoadModel back = fromMessage(message);
  EXPECT_EQ(back.stamp, road.stamp);
  EXPECT_TRUE(back.at_intersection);
  EXPECT_EQ(back.intersection_probability, 0.25);
  ASSERT_EQ(back.borders.size(), 2U);
  const RoadBorder& left = back.borders[0];
  EXPECT_EQ(left.side, RoadSide::kLeft);
  EXPECT_FALSE(left.side_street);
  EXPECT_EQ(left.probability, 0.75);
  EXPECT_EQ(left.unseen_for, 0.5);
  ASSERT_EQ(left.points.size(), 3U);
  EXPECT_EQ(left.points[1].position, Point2(10.0, 3.0));
  EXPECT_EQ(left.points[1].sigma, 0.25);
  EXPECT_EQ(back.borders[1].side, RoadSide::kRight);
  EXPECT_TRUE(back.borders[1].side_street);
}

TEST(RoadConversion, NoBordersIsARoad) {
  const RoadModel back = fromMessage(toMessage(RoadModel(), "map"));
  EXPECT_TRUE(back.borders.empty());
  EXPECT_FALSE(back.at_intersection);
}

TEST(RoadConversion, BordersOfFewerThanTwoPointsAreRefused) {
  EXPECT_EQ(reasonAfterBorder([](auto& border) {
              border.points.resize(1);
              border.sigma.resize(1);
            }),
            "bad_border");
  EXPECT_EQ(reasonToPublish([](auto& road) { road.borders[1].points.clear(); }), "bad_border");
}

TEST(RoadConversion, PointsMustBeFiniteWithAStandardDeviationEach) {
  EXPECT_EQ(reasonAfterBorder([](auto& border) { border.points[1].x = kNaN; }), "bad_border");
  EXPECT_EQ(reasonAfterBorder([](auto& border) { border.points[2].y = kInfinity; }), "bad_border");
  EXPECT_EQ(reasonAfterBorder([](auto& border) { border.points[2].x = 1e30F; }), "bad_border");
  EXPECT_EQ(reasonAfterBorder([](auto& border) { border.sigma[0] = 1e30F; }), "bad_border");
  EXPECT_EQ(reasonAfterBorder([](auto& border) { border.sigma.pop_back(); }), "bad_border");
  EXPECT_EQ(reasonAfterBorder([](auto& border) { border.sigma[0] = -0.1F; }), "bad_border");
  EXPECT_EQ(reasonAfterBorder([](auto& border) { border.sigma[0] = kNaN; }), "bad_border");
  EXPECT_EQ(reasonAfterBorder([](auto& border) { border.sigma[0] = 0.0F; }), "");
  EXPECT_EQ(reasonToPublish([](auto& road) { road.borders[0].points[0].sigma = kNaN; }),
            "bad_border");
}

TEST(RoadConversion, SideProbabilityAndAgeMustMeanSomething) {
  EXPECT_EQ(reasonAfterBorder([](auto& border) { border.side = 2; }), "bad_border");
  EXPECT_EQ(reasonAfterBorder([](auto& border) { border.probability = 1.1F; }), "bad_border");
  EXPECT_EQ(reasonAfterBorder([](auto& border) { border.probability = kNaN; }), "bad_border");
  EXPECT_EQ(reasonAfterBorder([](auto& border) { border.unseen = ros::Duration(-1.0); }),
            "bad_border");
  EXPECT_EQ(reasonToPublish([](auto& road) { road.borders[0].unseen_for = 1e300; }), "bad_border");
  EXPECT_EQ(reasonToPublish([](auto& road) { road.borders[0].unseen_for = kNaN; }), "bad_border");
}

TEST(RoadConversion, AnIntersectionsProbabilityIsFromZeroToOne) {
  EXPECT_EQ(reasonAfter([](auto& message) { message.intersection_probability = -0.1F; }),
            "bad_road");
  EXPECT_EQ(reasonToPublish([](auto& road) { road.intersection_probability = kNaN; }), "bad_road");
}

TEST(RoadConversion, PointsAreBoundedOverAllBorders) {
  const auto filled = [](std::size_t points) {
    return [points](RoadBorders& message) {
      RoadBorderMessage border = message.borders.at(0);
      border.points.resize(points / 4, border.points[0]);
      border.sigma.resize(points / 4, 0.1F);
      message.borders.assign(4, border);
    };
  };
  EXPECT_EQ(reasonAfter(filled(kMaxBorderPoints)), "");
  EXPECT_EQ(reasonAfter(filled(kMaxBorderPoints + 4)), "many_points");
}

TEST(RoadConversion, ErrorsAreReportedWithTheValue) {
  RoadModel road = straightRoad();
  road.borders[0].points.pop_back();
  road.borders[0].points.pop_back();
  try {
    toMessage(road, "map");
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "border of a road of 1 points: expected two at least");
  }
}

TEST(RoadConversion, DroppedObjectsHaveAReason) {
  std::vector<DroppedObject> objects(1);
  DroppedObject& dropped = objects.front();
  dropped.object.box = {{5.0, 6.0, 0.0}, 4.0, 2.0};
  dropped.reason = DropReason::kBeyondBorder;
  dropped.side = RoadSide::kRight;
  dropped.beyond = 1.5;
  const DroppedObjects message = toMessage(objects, Stamp::fromSeconds(7.0), "base_link");
  EXPECT_EQ(message.header.frame_id, "base_link");
  EXPECT_EQ(message.header.stamp, ros::Time(7.0));
  ASSERT_EQ(message.objects.size(), 1U);
  const DroppedObjectMessage& got = message.objects[0];
  EXPECT_EQ(got.object.pose.position.x, 5.0);
  EXPECT_EQ(got.object.size.x, 4.0);
  EXPECT_EQ(got.reason, DroppedObjectMessage::BEYOND_BORDER);
  EXPECT_EQ(got.side, RoadBorderMessage::RIGHT);
  EXPECT_EQ(got.beyond, 1.5F);
}

}  // namespace
}  // namespace datmo::road_conversion_test
