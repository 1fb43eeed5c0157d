// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_offset.h"

#include <gtest/gtest.h>

namespace datmo::border_offset_test {
namespace {

RoadBorder borderOf(RoadSide side, std::vector<BorderPoint> points) {
  RoadBorder border;
  border.side = side;
  border.points = std::move(points);
  return border;
}

TEST(BorderOffsetTest, OutwardIsAwayFromTheRoad) {
  const std::vector<BorderPoint> ahead{{{0.0, 0.0}, 0.2}, {{10.0, 0.0}, 0.4}};
  const RoadBorder left = borderOf(RoadSide::kLeft, ahead);
  const RoadBorder right = borderOf(RoadSide::kRight, ahead);
  EXPECT_DOUBLE_EQ(offsetFrom(left, {5.0, 2.0})->outward, 2.0);
  EXPECT_DOUBLE_EQ(offsetFrom(left, {5.0, -2.0})->outward, -2.0);
  EXPECT_DOUBLE_EQ(offsetFrom(right, {5.0, -2.0})->outward, 2.0);
  EXPECT_DOUBLE_EQ(offsetFrom(right, {5.0, 2.0})->outward, -2.0);
}

TEST(BorderOffsetTest, SigmaIsThatOfThePointOnTheBorder) {
  const RoadBorder border = borderOf(RoadSide::kLeft, {{{0.0, 0.0}, 0.2}, {{10.0, 0.0}, 0.4}});
  EXPECT_NEAR(offsetFrom(border, {2.5, 1.0})->sigma, 0.25, 1e-12);
}

TEST(BorderOffsetTest, BesideNoPartOfTheBorderThereIsNone) {
  const RoadBorder border = borderOf(RoadSide::kLeft, {{{0.0, 0.0}, 0.2}, {{10.0, 0.0}, 0.2}});
  EXPECT_FALSE(offsetFrom(border, {-0.1, 1.0}));
  EXPECT_FALSE(offsetFrom(border, {10.1, 1.0}));
  EXPECT_FALSE(offsetFrom(borderOf(RoadSide::kLeft, {}), {0.0, 0.0}));
}

TEST(BorderOffsetTest, TheNearestLegCounts) {
  // A road that turns left: the point lies beside both legs.
  const RoadBorder border =
      borderOf(RoadSide::kRight, {{{0.0, 0.0}, 0.1}, {{10.0, 0.0}, 0.1}, {{10.0, 10.0}, 0.1}});
  EXPECT_DOUBLE_EQ(offsetFrom(border, {9.0, 3.0})->outward, -1.0);
  EXPECT_DOUBLE_EQ(offsetFrom(border, {11.0, 3.0})->outward, 1.0);
  EXPECT_EQ(offsetFrom(border, {11.0, 3.0})->direction, Point2(0.0, 1.0));
}

TEST(BorderOffsetTest, ALegWithoutLengthIsLeftOut) {
  const RoadBorder border =
      borderOf(RoadSide::kLeft, {{{0.0, 0.0}, 0.1}, {{0.0, 0.0}, 0.1}, {{10.0, 0.0}, 0.1}});
  EXPECT_DOUBLE_EQ(offsetFrom(border, {5.0, 2.0})->outward, 2.0);
}

}  // namespace
}  // namespace datmo::border_offset_test
