// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/box2.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "datmo_fusion/common/box_extent.h"

namespace datmo::box2_test {
namespace {

/// 4 m x 2 m, facing left: x from 9 to 11, y from 3 to 7.
const Box2 kCar{{10.0, 5.0, kPi / 2.0}, 4.0, 2.0};

TEST(Box2, CornersGoRoundFromFrontLeft) {
  const auto corners = kCar.corners();
  const std::array<Point2, 4> expected{Point2(9, 7), Point2(9, 3), Point2(11, 3), Point2(11, 7)};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR((corners.at(i) - expected.at(i)).norm(), 0.0, 1e-12) << i;
  }
}

TEST(Box2, CornersAreHalfTheDiagonalFromTheCenter) {
  for (const Point2& corner : kCar.corners()) {
    EXPECT_NEAR((corner - kCar.center.position()).norm(), kCar.halfDiagonal(), 1e-12);
  }
}

TEST(Box2, ContainsInsideAndBorder) {
  const Box2 straight{{0.0, 0.0, 0.0}, 4.0, 2.0};
  EXPECT_TRUE(straight.contains({1.9, -0.9}));
  EXPECT_TRUE(straight.contains({2.0, 1.0}));
  EXPECT_FALSE(straight.contains({2.1, 0.0}));
  EXPECT_FALSE(straight.contains({0.0, 1.1}));
}

TEST(Box2, DistanceToSideCornerAndInside) {
  EXPECT_NEAR(kCar.distanceTo({13.0, 5.0}), 2.0, 1e-12);
  EXPECT_NEAR(kCar.distanceTo({14.0, 11.0}), 5.0, 1e-12) << "3 m and 4 m from the corner";
  EXPECT_EQ(kCar.distanceTo({10.0, 6.0}), 0.0);
}

TEST(Box2, NoPointIsFartherFromTheBoxThanFromItsCorners) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> meters(-30.0, 30.0);
  for (int i = 0; i < 200; ++i) {
    const Point2 point(meters(random), meters(random));
    double to_corner = std::numeric_limits<double>::infinity();
    for (const Point2& corner : kCar.corners()) {
      to_corner = std::min(to_corner, (corner - point).norm());
    }
    EXPECT_LE(kCar.distanceTo(point), to_corner + 1e-12);
  }
}

TEST(BoxExtentTest, IsTheShadowOnALine) {
  const Box2 box{Pose2(3.0, 4.0, kPi / 2.0), 4.0, 2.0};  // its length is along y
  EXPECT_NEAR(extentAlong(box, Point2(0.0, 1.0)), 4.0, 1e-12);
  EXPECT_NEAR(extentAlong(box, Point2(-1.0, 0.0)), 2.0, 1e-12);
  EXPECT_NEAR(extentAlong(box, Point2(std::sqrt(0.5), std::sqrt(0.5))), 6.0 * std::sqrt(0.5),
              1e-12);
}

}  // namespace
}  // namespace datmo::box2_test
