// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/shape.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace datmo::simulator::shape_test {
namespace {

const HalfLine kAlongX = {{0.0, 0.0}, {1.0, 0.0}};

TEST(RangeTo, BoxIsHitAtItsNearSide) {
  const Box2 box{{10.0, 0.5, 0.0}, 4.0, 2.0};
  EXPECT_DOUBLE_EQ(*rangeTo(box, kAlongX), 8.0);
}

TEST(RangeTo, TurnedBoxIsHitAtItsCorner) {
  const Box2 box{{10.0, 0.0, kPi / 4.0}, 2.0, 2.0};
  EXPECT_NEAR(*rangeTo(box, kAlongX), 10.0 - std::sqrt(2.0), 1e-12);
}

TEST(RangeTo, ShapesBesideAndBehindAreMissed) {
  EXPECT_FALSE(rangeTo(Box2{{10.0, 1.5, 0.0}, 4.0, 2.0}, kAlongX));
  EXPECT_FALSE(rangeTo(Box2{{-10.0, 0.0, 0.0}, 4.0, 2.0}, kAlongX));
  EXPECT_FALSE(rangeTo(Circle{{10.0, 1.01}, 1.0}, kAlongX));
  EXPECT_FALSE(rangeTo(Circle{{-10.0, 0.0}, 1.0}, kAlongX));
  EXPECT_FALSE(rangeTo(Segment{{5.0, 0.1}, {5.0, 2.0}}, kAlongX));
  EXPECT_FALSE(rangeTo(Segment{{-5.0, -1.0}, {-5.0, 1.0}}, kAlongX));
}

TEST(RangeTo, CircleOffTheAxis) {
  // 3-4-5 triangle: half the chord is 4 m.
  EXPECT_DOUBLE_EQ(*rangeTo(Circle{{10.0, 3.0}, 5.0}, kAlongX), 6.0);
}

TEST(RangeTo, SegmentAcrossAndParallel) {
  EXPECT_DOUBLE_EQ(*rangeTo(Segment{{5.0, -1.0}, {7.0, 1.0}}, kAlongX), 6.0);
  EXPECT_FALSE(rangeTo(Segment{{5.0, 0.0}, {7.0, 0.0}}, kAlongX));
}

TEST(RangeTo, FromInsideItIsTheDistanceOut) {
  EXPECT_DOUBLE_EQ(*rangeTo(Box2{{0.0, 0.0, 0.0}, 4.0, 2.0}, kAlongX), 2.0);
  EXPECT_DOUBLE_EQ(*rangeTo(Circle{{0.0, 0.0}, 3.0}, kAlongX), 3.0);
}

TEST(RangeTo, HitPointIsOnTheOutline) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> position(-20.0, 20.0);
  std::uniform_real_distribution<double> heading(-kPi, kPi);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Box2 box{{position(random), position(random), heading(random)}, 4.5, 1.8};
    const HalfLine ray = halfLine({position(random), position(random)}, heading(random));
    if (const auto range = rangeTo(box, ray)) {
      const Point2 hit = ray.origin + *range * ray.direction;
      const Point2 local = box.center.inverse() * hit;
      const double outside = std::max(std::abs(local.x()) - 2.25, std::abs(local.y()) - 0.9);
      EXPECT_NEAR(outside, 0.0, 1e-9);
      ++hits;
    }
  }
  EXPECT_GT(hits, 50);
}

TEST(Overlap, BoxesByTheirSides) {
  const Box2 box{{0.0, 0.0, 0.0}, 4.0, 2.0};
  EXPECT_TRUE(overlap(box, Box2{{3.9, 0.0, 0.0}, 4.0, 2.0}));
  EXPECT_FALSE(overlap(box, Box2{{4.1, 0.0, 0.0}, 4.0, 2.0}));
  // Turned by 45 degrees, half a diagonal is 1.414 m.
  EXPECT_TRUE(overlap(box, Box2{{3.40, 0.0, kPi / 4.0}, 2.0, 2.0}));
  EXPECT_FALSE(overlap(box, Box2{{3.43, 0.0, kPi / 4.0}, 2.0, 2.0}));
}

TEST(Overlap, CirclesAndSegments) {
  const Box2 box{{0.0, 0.0, 0.0}, 4.0, 2.0};
  EXPECT_TRUE(overlap(box, Circle{{2.5, 0.0}, 0.6}));
  EXPECT_FALSE(overlap(box, Circle{{2.5, 1.5}, 0.6}));
  EXPECT_TRUE(overlap(Circle{{0.0, 0.0}, 1.0}, Circle{{1.5, 0.0}, 0.6}));
  EXPECT_FALSE(overlap(Circle{{0.0, 0.0}, 1.0}, Circle{{1.7, 0.0}, 0.6}));
  EXPECT_TRUE(overlap(Segment{{-5.0, 0.5}, {5.0, 0.5}}, box));
  EXPECT_FALSE(overlap(Segment{{-5.0, 1.1}, {5.0, 1.1}}, box));
  EXPECT_FALSE(overlap(Segment{{3.0, 0.0}, {5.0, 0.0}}, box));
}

TEST(BoundingCircle, HoldsTheCorners) {
  const Circle circle = boundingCircle(Box2{{1.0, 2.0, 0.3}, 8.0, 6.0});
  EXPECT_DOUBLE_EQ(circle.radius, 5.0);
  EXPECT_EQ(circle.center, Point2(1.0, 2.0));
  EXPECT_DOUBLE_EQ(boundingCircle(Segment{{0.0, 0.0}, {4.0, 0.0}}).radius, 2.0);
}

}  // namespace
}  // namespace datmo::simulator::shape_test
