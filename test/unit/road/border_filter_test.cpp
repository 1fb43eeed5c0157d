// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_filter.h"

#include "scan_history_samples.h"
#include <gtest/gtest.h>

namespace datmo {
namespace {

using samples::scanOf;

/// Borders 4 m to the left and to the right of the x axis.
RoadModel straightRoad() {
  RoadModel road;
  for (const RoadSide side : {RoadSide::kLeft, RoadSide::kRight}) {
    const double y = side == RoadSide::kLeft ? 4.0 : -4.0;
    RoadBorder border;
    border.side = side;
    border.points = {{{0.0, y}, 0.1}, {{40.0, y}, 0.1}};
    road.borders.push_back(border);
  }
  return road;
}

Object movingAt(const Point2& position) {
  Object object;
  object.box = {Pose2(position, 0.0), 0.5, 0.5};
  object.points = {position};
  object.dynamic_state = DynamicState::kMoving;
  return object;
}

class BorderFilterTest : public testing::Test {
 protected:
  /// A second of scans in which nothing is at the place, or something in every other scan.
  void watch(BorderFilter& filter, const Point2& position, bool reflects) {
    for (int i = 0; i < 16; ++i) {
      ObjectList none;
      const bool hit = reflects && i % 2 == 0;
      filter.filter(scanOf(hit ? std::vector<Point2>{position} : std::vector<Point2>{}, 0.06 * i),
                    {}, none);
    }
  }

  /// What the filter drops of an object that is seen after that second.
  std::vector<DroppedObject> seenAfter(BorderFilter& filter, const Object& object) {
    list_.objects = {object};
    return filter.filter(scanOf(object.points, 1.0), road_, list_);
  }

  RoadModel road_ = straightRoad();
  ObjectList list_;
  BorderFilter filter_{BorderFilterOptions{}};
};

TEST_F(BorderFilterTest, DropsWhatReflectsOnABorder) {
  const Point2 curb(20.0, 4.2);
  watch(filter_, curb, true);
  const auto dropped = seenAfter(filter_, movingAt(curb));
  ASSERT_EQ(dropped.size(), 1U);
  EXPECT_TRUE(list_.objects.empty());
  EXPECT_EQ(dropped[0].reason, DropReason::kOnBorder);
  EXPECT_EQ(dropped[0].side, RoadSide::kLeft);
  EXPECT_NEAR(dropped[0].beyond, 0.2, 1e-9);
  EXPECT_LT(dropped[0].motion_evidence, 1.0);
  EXPECT_EQ(dropped[0].object.points.size(), 1U);
}

TEST_F(BorderFilterTest, DropsWhatReflectsBeyondABorder) {
  const Point2 hedge(20.0, -6.0);
  watch(filter_, hedge, true);
  const auto dropped = seenAfter(filter_, movingAt(hedge));
  ASSERT_EQ(dropped.size(), 1U);
  EXPECT_EQ(dropped[0].reason, DropReason::kBeyondBorder);
  EXPECT_EQ(dropped[0].side, RoadSide::kRight);
}

TEST_F(BorderFilterTest, KeepsWhatIsOnTheRoad) {
  const Point2 lane(20.0, 3.0);
  watch(filter_, lane, true);
  EXPECT_TRUE(seenAfter(filter_, movingAt(lane)).empty());
  EXPECT_EQ(list_.objects.size(), 1U);
}

TEST_F(BorderFilterTest, KeepsWhoComesAlongTheFootpath) {
  const Point2 footpath(20.0, 5.735);  // in the middle of a beam
  watch(filter_, footpath, false);
  EXPECT_TRUE(seenAfter(filter_, movingAt(footpath)).empty());
}

TEST_F(BorderFilterTest, TheThesisDropsHimToo) {
  BorderFilterOptions options;
  options.method = BorderFilterOptions::kThesis;
  BorderFilter filter(options);
  const Point2 footpath(20.0, 5.735);  // in the middle of a beam
  watch(filter, footpath, false);
  EXPECT_EQ(seenAfter(filter, movingAt(footpath)).size(), 1U);
}

TEST_F(BorderFilterTest, ByTheThesisOneCornerIsEnough) {
  Object car = movingAt({20.0, 3.0});
  car.box.width = 1.8;  // reaches to 3.9 m
  watch(filter_, {20.0, 3.0}, true);
  EXPECT_TRUE(seenAfter(filter_, car).empty());
  BorderFilterOptions options;
  options.method = BorderFilterOptions::kThesis;
  BorderFilter as_thesis(options);
  EXPECT_EQ(seenAfter(as_thesis, car).size(), 1U);
}

TEST_F(BorderFilterTest, KeepsWhatReachesIntoTheRoad) {
  Object car = movingAt({20.0, 4.2});
  car.points.emplace_back(20.0, 2.5);
  watch(filter_, {20.0, 4.2}, true);
  EXPECT_TRUE(seenAfter(filter_, car).empty());
}

TEST_F(BorderFilterTest, KeepsWhatNobodySaysToMove) {
  Object object = movingAt({20.0, 6.0});
  for (const DynamicState state : {DynamicState::kStatic, DynamicState::kUnknown}) {
    object.dynamic_state = state;
    BorderFilter filter{BorderFilterOptions{}};
    EXPECT_TRUE(seenAfter(filter, object).empty());
  }
}

TEST_F(BorderFilterTest, ABorderThatIsHardlyKnownDropsNothing) {
  for (RoadBorder& border : road_.borders) {
    for (BorderPoint& point : border.points) {
      point.sigma = 1.5;
    }
  }
  EXPECT_TRUE(seenAfter(filter_, movingAt({20.0, 6.0})).empty());
}

TEST_F(BorderFilterTest, BeyondABorderOfASideStreetNothingIsDropped) {
  for (RoadBorder& border : road_.borders) {
    border.side_street = true;
  }
  EXPECT_EQ(seenAfter(filter_, movingAt({20.0, 4.3})).size(), 1U);
  BorderFilter other{BorderFilterOptions{}};
  EXPECT_TRUE(seenAfter(other, movingAt({20.0, 6.0})).empty());
}

TEST_F(BorderFilterTest, WhatIsFarBeyondIsAnotherRoad) {
  EXPECT_TRUE(seenAfter(filter_, movingAt({20.0, 36.0})).empty());
}

TEST_F(BorderFilterTest, WhereNoBorderIsKnownItGoesOn) {
  for (RoadBorder& border : road_.borders) {
    border.points.back().position.x() = 10.0;
  }
  const auto beyond = seenAfter(filter_, movingAt({20.0, 6.0}));
  ASSERT_EQ(beyond.size(), 1U);
  EXPECT_EQ(beyond[0].reason, DropReason::kBeyondBorder);
  BorderFilter other{BorderFilterOptions{}};
  const auto on = seenAfter(other, movingAt({20.0, -4.3}));
  ASSERT_EQ(on.size(), 1U);
  EXPECT_EQ(on[0].reason, DropReason::kOnBorder);
  EXPECT_EQ(on[0].side, RoadSide::kRight);
}

TEST_F(BorderFilterTest, WhoComesThereStays) {
  for (RoadBorder& border : road_.borders) {
    border.points.back().position.x() = 10.0;
  }
  const Point2 side_street(20.0, 5.735);  // in the middle of a beam
  watch(filter_, side_street, false);
  EXPECT_TRUE(seenAfter(filter_, movingAt(side_street)).empty());
}

TEST_F(BorderFilterTest, WithoutARoadAllPass) {
  road_ = {};
  EXPECT_TRUE(seenAfter(filter_, movingAt({20.0, 4.2})).empty());
}

TEST_F(BorderFilterTest, AfterAResetItKnowsNoFreePoints) {
  const Point2 footpath(20.0, 5.735);  // in the middle of a beam
  watch(filter_, footpath, false);
  filter_.reset();
  EXPECT_EQ(seenAfter(filter_, movingAt(footpath)).size(), 1U);
}

}  // namespace
}  // namespace datmo
