// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/border_filter.h"

#include <vector>

#include <gtest/gtest.h>

namespace datmo::border_filter_test {
namespace {

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
  /// Returns the object as the filter passes it on.
  Object passed(const Object& object) {
    list_.objects = {object};
    EXPECT_TRUE(filter_.filter(Pose2(), road_, list_).empty());
    return list_.objects.at(0);
  }

  /// Returns whether the filter considers it less likely to move than on the road.
  bool isOutside(const Object& object) {
    const Object result = passed(object);
    const bool weighed = result.motion_log_odds < 0.0;
    EXPECT_EQ(result.dynamic_state, weighed ? DynamicState::kUnknown : object.dynamic_state);
    return weighed;
  }

  RoadModel road_ = straightRoad();
  ObjectList list_;
  BorderFilter filter_{BorderFilterOptions{}};
};

TEST_F(BorderFilterTest, OnABorderItIsLessLikelyToMove) {
  const Object curb = passed(movingAt({20.0, 4.2}));
  EXPECT_EQ(curb.motion_log_odds, BorderFilterOptions{}.motion_log_odds);
  EXPECT_EQ(curb.dynamic_state, DynamicState::kUnknown) << "the tracker decides";
  EXPECT_EQ(curb.points.size(), 1U);
}

TEST_F(BorderFilterTest, BeyondABorderToo) { EXPECT_TRUE(isOutside(movingAt({20.0, -6.0}))); }

TEST_F(BorderFilterTest, OnTheRoadNothingIsOutside) {
  EXPECT_FALSE(isOutside(movingAt({20.0, 3.0})));
}

TEST_F(BorderFilterTest, ObjectsReachingIntoTheRoadAreOnIt) {
  Object car = movingAt({20.0, 4.2});
  car.points.emplace_back(20.0, 2.5);
  EXPECT_FALSE(isOutside(car));
}

TEST_F(BorderFilterTest, UndecidedObjectsAreWeightedToo) {
  Object object = movingAt({20.0, 6.0});
  object.dynamic_state = DynamicState::kUnknown;
  EXPECT_TRUE(isOutside(object));
}

TEST_F(BorderFilterTest, StaticObjectsStayStatic) {
  Object object = movingAt({20.0, 6.0});
  object.dynamic_state = DynamicState::kStatic;
  EXPECT_FALSE(isOutside(object));
}

TEST_F(BorderFilterTest, AnUncertainBorderIsUninformative) {
  for (RoadBorder& border : road_.borders) {
    for (BorderPoint& point : border.points) {
      point.sigma = 1.5;
    }
  }
  EXPECT_FALSE(isOutside(movingAt({20.0, 6.0})));
}

TEST_F(BorderFilterTest, BeyondABorderOfASideStreetIsTheStreet) {
  for (RoadBorder& border : road_.borders) {
    border.side_street = true;
  }
  EXPECT_TRUE(isOutside(movingAt({20.0, 4.3})));
  EXPECT_FALSE(isOutside(movingAt({20.0, 6.0})));
}

TEST_F(BorderFilterTest, DistantObjectsAreOnAnotherRoad) {
  EXPECT_FALSE(isOutside(movingAt({20.0, 36.0})));
}

TEST_F(BorderFilterTest, WithoutAKnownBorderTheRoadContinues) {
  for (RoadBorder& border : road_.borders) {
    border.points.back().position.x() = 10.0;
  }
  EXPECT_TRUE(isOutside(movingAt({20.0, 6.0})));
  EXPECT_TRUE(isOutside(movingAt({20.0, -4.3})));
  filter_.forgetRoad();
  road_ = {};
  EXPECT_FALSE(isOutside(movingAt({20.0, 6.0})));
}

TEST_F(BorderFilterTest, WhereTheKnownRoadEndsAllPointsCount) {
  for (RoadBorder& border : road_.borders) {
    border.points.back().position.x() = 20.0;
  }
  Object car = movingAt({20.5, 3.8});
  EXPECT_TRUE(isOutside(car));
  car.points.emplace_back(19.5, 2.0);  // beside the known border, on the road
  EXPECT_FALSE(isOutside(car));
}

TEST_F(BorderFilterTest, WithoutARoadNothingIsOutside) {
  road_ = {};
  EXPECT_FALSE(isOutside(movingAt({20.0, 4.2})));
}

class ThesisBorderFilterTest : public BorderFilterTest {
 protected:
  static BorderFilterOptions asThesis() {
    BorderFilterOptions options;
    options.method = BorderFilterMethod::kThesis;
    return options;
  }

  std::vector<DroppedObject> dropped(const Object& object) {
    list_.objects = {object};
    auto result = thesis_.filter(Pose2(), road_, list_);
    EXPECT_EQ(result.size() + list_.objects.size(), 1U);
    return result;
  }

  BorderFilter thesis_{asThesis()};
};

TEST_F(ThesisBorderFilterTest, DropsObjectsOnABorder) {
  const auto on = dropped(movingAt({20.0, 4.2}));
  ASSERT_EQ(on.size(), 1U);
  EXPECT_EQ(on[0].reason, DropReason::kOnBorder);
  EXPECT_EQ(on[0].side, RoadSide::kLeft);
  EXPECT_NEAR(on[0].beyond, 0.45, 1e-9) << "of its outermost corner";
  EXPECT_EQ(on[0].object.points.size(), 1U);
}

TEST_F(ThesisBorderFilterTest, DropsObjectsBeyond) {
  const auto beyond = dropped(movingAt({20.0, -6.0}));
  ASSERT_EQ(beyond.size(), 1U);
  EXPECT_EQ(beyond[0].reason, DropReason::kBeyondBorder);
  EXPECT_EQ(beyond[0].side, RoadSide::kRight);
}

TEST_F(ThesisBorderFilterTest, OneCornerIsEnough) {
  Object car = movingAt({20.0, 3.0});
  EXPECT_TRUE(dropped(car).empty());
  car.box.width = 1.8;  // reaches to 3.9 m
  EXPECT_EQ(dropped(car).size(), 1U);
}

TEST_F(ThesisBorderFilterTest, KeepsObjectsNotReportedAsMoving) {
  Object object = movingAt({20.0, 6.0});
  for (const DynamicState state : {DynamicState::kStatic, DynamicState::kUnknown}) {
    object.dynamic_state = state;
    EXPECT_TRUE(dropped(object).empty());
    EXPECT_EQ(list_.objects[0].motion_log_odds, 0.0);
  }
}

}  // namespace
}  // namespace datmo::border_filter_test
