// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/road_opening.h"

#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::road_opening_test {
namespace {

/// Stations of 1 m from 10 m behind the vehicle to 40 m ahead, each with a border.
SidePresence bordered() {
  SidePresence side;
  side.first_station = 90.5;
  side.probability.assign(50, 0.9);
  return side;
}

/// No border from one arc length to another, m.
void open(SidePresence& side, double from, double to, double probability = 0.1) {
  for (std::size_t i = 0; i < side.probability.size(); ++i) {
    const double station = side.first_station + static_cast<double>(i) * side.station_length;
    if (station >= from && station < to) {
      side.probability[i] = probability;
    }
  }
}

class RoadOpeningTest : public testing::Test {
 protected:
  RoadOpeningTest() {
    presence_.arc_length = 100.0;
    presence_.left = bordered();
    presence_.right = bordered();
    RoadBorder right;
    right.side = RoadSide::kRight;
    right.points = {{{-10.0, -4.0}, 0.1}, {{15.0, -4.0}, 0.1}};
    borders_ = {right};
  }

  std::vector<RoadOpening> openings(const Pose2& vehicle = {}) const {
    return openingsOf(presence_, borders_, vehicle, RoadOpeningOptions{});
  }

  BorderPresence presence_;
  std::vector<RoadBorder> borders_;
};

TEST_F(RoadOpeningTest, ARoadBetweenBordersHasNone) { EXPECT_TRUE(openings().empty()); }

TEST_F(RoadOpeningTest, FacesOutOfTheRoadFromTheMiddleOfTheOpening) {
  open(presence_.right, 120.0, 132.0);
  const auto found = openings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].side, RoadSide::kRight);
  EXPECT_NEAR(found[0].length, 12.0, 1e-9);
  EXPECT_NEAR(found[0].middle.x(), 26.0, 1e-9);
  EXPECT_NEAR(found[0].middle.y(), -4.0, 1e-9) << "as far as the nearest border";
  EXPECT_NEAR(found[0].middle.heading(), -0.5 * kPi, 1e-9);
}

TEST_F(RoadOpeningTest, WithoutABorderTheDefaultDistanceIsUsed) {
  open(presence_.left, 120.0, 132.0);
  const auto found = openings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].side, RoadSide::kLeft);
  EXPECT_NEAR(found[0].middle.y(), 5.0, 1e-9);
  EXPECT_NEAR(found[0].middle.heading(), 0.5 * kPi, 1e-9);
}

TEST_F(RoadOpeningTest, ALastRunThatContinuesIsOneToo) {
  open(presence_.left, 125.0, 200.0);
  ASSERT_EQ(openings().size(), 1U);
  EXPECT_NEAR(openings()[0].length, 15.0, 1e-9);
}

TEST_F(RoadOpeningTest, ShortOrEndlessOnesAreNone) {
  open(presence_.left, 120.0, 124.0);
  open(presence_.right, 91.5, 200.0);
  EXPECT_TRUE(openings().empty());
}

TEST_F(RoadOpeningTest, InUnknownSpaceThereIsNone) {
  open(presence_.left, 120.0, 132.0, 0.5);
  EXPECT_TRUE(openings().empty());
}

TEST_F(RoadOpeningTest, ARoadThatNeverHadABorderHasNone) {
  open(presence_.left, 0.0, 120.0);
  EXPECT_TRUE(openings().empty()) << "before the first border";
}

TEST_F(RoadOpeningTest, TurnsWithTheVehicle) {
  open(presence_.right, 120.0, 132.0);
  const Pose2 vehicle(50.0, 60.0, 0.5 * kPi);
  borders_[0].points = {{vehicle * Point2(-10.0, -4.0), 0.1}, {vehicle * Point2(15.0, -4.0), 0.1}};
  const auto found = openings(vehicle);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].middle.x(), 54.0, 1e-9);
  EXPECT_NEAR(found[0].middle.y(), 86.0, 1e-9);
  EXPECT_NEAR(found[0].middle.heading(), 0.0, 1e-9);
}

}  // namespace
}  // namespace datmo::road_opening_test
