// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/side_streets.h"

#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::side_streets_test {
namespace {

Stamp at(double seconds) { return Stamp::fromSeconds(100.0 + seconds); }

/// A street of 10 m opens at x = 20 to the left of a road along x whose border is at y = 5.
class SideStreetsTest : public testing::Test {
 protected:
  SideStreetsTest() {
    for (int i = 0; i < 60; ++i) {
      const double y = 6.0 + 0.25 * i;
      for (const double x : {15.0, 25.0}) {
        for (int hits = 0; hits < 4; ++hits) {
          hits_.add({x, y}, at(hits));
        }
      }
    }
    opening_.side = RoadSide::kLeft;
    opening_.middle = Pose2(20.0, 5.0, 0.5 * kPi);
    opening_.length = 10.0;
  }

  HitGrid hits_{HitGridOptions{}};
  RoadOpening opening_;
  SideStreets streets_{SideStreetOptions{}};
};

TEST_F(SideStreetsTest, FindsBothBordersOfAStreet) {
  streets_.update(hits_, {opening_}, at(0.0));
  const auto borders = streets_.borders(at(0.0));
  ASSERT_EQ(borders.size(), 2U);
  for (const RoadBorder& border : borders) {
    EXPECT_TRUE(border.side_street);
    EXPECT_EQ(border.side, RoadSide::kLeft) << "of the vehicle's road";
    const double x = border.points.front().position.x();
    EXPECT_NEAR(std::abs(x - 20.0), 5.0, 0.2);
    for (const BorderPoint& point : border.points) {
      EXPECT_NEAR(point.position.x(), x, 0.2);
      EXPECT_GT(point.sigma, 0.0);
    }
    EXPECT_LT(border.points.front().position.y(), border.points.back().position.y());
    EXPECT_DOUBLE_EQ(border.unseen_for, 0.0);
  }
}

TEST_F(SideStreetsTest, KeepsThemForATime) {
  streets_.update(hits_, {opening_}, at(0.0));
  const HitGrid empty{HitGridOptions{}};
  streets_.update(empty, {opening_}, at(2.0));
  ASSERT_EQ(streets_.borders(at(2.0)).size(), 2U);
  EXPECT_NEAR(streets_.borders(at(2.0))[0].unseen_for, 2.0, 1e-9);
  streets_.update(empty, {opening_}, at(4.0));
  EXPECT_TRUE(streets_.borders(at(4.0)).empty());
}

TEST_F(SideStreetsTest, FindsNoneTwice) {
  for (int i = 0; i < 5; ++i) {
    streets_.update(hits_, {opening_}, at(0.3 * i));
  }
  EXPECT_EQ(streets_.borders(at(1.2)).size(), 2U);
}

TEST_F(SideStreetsTest, TheLatestOneReplacesContradictoryOnes) {
  // From a turning vehicle: the opening appears elsewhere, and another line is found.
  HitGrid slanted{HitGridOptions{}};
  for (int i = 0; i < 60; ++i) {
    for (int hits = 0; hits < 4; ++hits) {
      slanted.add({14.0 + 0.05 * i, 6.0 + 0.25 * i}, at(hits));
    }
  }
  streets_.update(slanted, {opening_}, at(0.0));
  ASSERT_EQ(streets_.borders(at(0.0)).size(), 1U) << "the left one";
  streets_.update(hits_, {opening_}, at(0.5));
  const auto borders = streets_.borders(at(0.5));
  ASSERT_EQ(borders.size(), 2U);
  for (const RoadBorder& border : borders) {
    EXPECT_NEAR(border.points.front().position.x(), border.points.back().position.x(), 0.2);
  }
}

TEST_F(SideStreetsTest, TwoStreetsSideBySideHaveFourBorders) {
  for (int i = 0; i < 60; ++i) {
    for (const double x : {33.0, 43.0}) {
      for (int hits = 0; hits < 4; ++hits) {
        hits_.add({x, 6.0 + 0.25 * i}, at(hits));
      }
    }
  }
  RoadOpening second = opening_;
  second.middle = Pose2(38.0, 5.0, 0.5 * kPi);
  streets_.update(hits_, {opening_, second}, at(0.0));
  EXPECT_EQ(streets_.borders(at(0.0)).size(), 4U);
}

TEST_F(SideStreetsTest, SearchesPeriodically) {
  streets_.update(hits_, {}, at(0.0));
  streets_.update(hits_, {opening_}, at(0.1));
  EXPECT_TRUE(streets_.borders(at(0.1)).empty());
  streets_.update(hits_, {opening_}, at(0.3));
  EXPECT_EQ(streets_.borders(at(0.3)).size(), 2U);
}

TEST_F(SideStreetsTest, WithoutAnOpeningThereIsNone) {
  streets_.update(hits_, {}, at(0.0));
  EXPECT_TRUE(streets_.borders(at(0.0)).empty());
}

TEST_F(SideStreetsTest, ForgetsAllByAReset) {
  streets_.update(hits_, {opening_}, at(0.0));
  streets_.reset();
  EXPECT_TRUE(streets_.borders(at(0.0)).empty());
  streets_.update(hits_, {opening_}, at(0.05));
  EXPECT_EQ(streets_.borders(at(0.05)).size(), 2U);
}

}  // namespace
}  // namespace datmo::side_streets_test
