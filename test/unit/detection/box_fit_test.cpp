#include "datmo_fusion/detection/box_fit.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo {
namespace {

/// Points every 0.25 m on the rear and the right side of a rectangle.
std::vector<Point2> lShape(const Box2& box) {
  std::vector<Point2> points;
  const auto corners = box.corners();
  const auto side = [&](const Point2& from, const Point2& to) {
    const int count = static_cast<int>((to - from).norm() / 0.25);
    for (int i = 0; i <= count; ++i) {
      points.push_back(from + (to - from) * (static_cast<double>(i) / count));
    }
  };
  side(corners[1], corners[2]);
  side(corners[2], corners[3]);
  return points;
}

TEST(BoxFitTest, NoPointsAreRefused) { EXPECT_THROW(fitBox({}), std::invalid_argument); }

TEST(BoxFitTest, OnePointIsABoxWithoutSize) {
  const Box2 box = fitBox({{3.0, -2.0}});
  EXPECT_TRUE(box.centre.position().isApprox(Point2(3.0, -2.0)));
  EXPECT_DOUBLE_EQ(box.length, 0.0);
  EXPECT_DOUBLE_EQ(box.width, 0.0);
}

TEST(BoxFitTest, TwoPointsAreALine) {
  const Box2 box = fitBox({{1.0, 1.0}, {2.0, 2.0}});
  EXPECT_NEAR(box.centre.heading(), degrees(45.0), 1e-9);
  EXPECT_NEAR(box.length, std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(box.width, 0.0, 1e-9);
  EXPECT_TRUE(box.centre.position().isApprox(Point2(1.5, 1.5)));
}

TEST(BoxFitTest, TheOrderOfThePointsDoesNotMatter) {
  // Scanners sweep to the left or to the right.
  for (double heading = -85.0; heading <= 90.0; heading += 7.0) {
    const Point2 from(20.0, 5.0);
    const Point2 to = Pose2(from, degrees(heading)) * Point2(1.5, 0.0);
    const Box2 one = fitBox({from, to});
    const Box2 other = fitBox({to, from});
    EXPECT_NEAR(one.centre.heading(), degrees(heading), 1e-9);
    EXPECT_NEAR(other.centre.heading(), degrees(heading), 1e-9);
    EXPECT_TRUE(one.centre.position().isApprox(other.centre.position(), 1e-12));
  }
}

TEST(BoxFitTest, AnLShapeGivesTheWholeRectangleAtAnyHeading) {
  for (double heading = -88.0; heading <= 90.0; heading += 7.0) {
    const Box2 truth{Pose2(12.0, -3.0, degrees(heading)), 4.4, 1.8};
    const Box2 box = fitBox(lShape(truth));
    EXPECT_NEAR(angleBetween(truth.centre.heading(), box.centre.heading()), 0.0, degrees(2.5))
        << heading;
    EXPECT_NEAR(box.length, 4.4, 0.15) << heading;
    EXPECT_NEAR(box.width, 1.8, 0.2) << heading;
    EXPECT_LT((box.centre.position() - truth.centre.position()).norm(), 0.1) << heading;
  }
}

TEST(BoxFitTest, EnclosesItsPointsAndIsLongerThanWide) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    std::vector<Point2> points;
    for (int k = 0; k < 3 + i % 10; ++k) {
      points.emplace_back(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    }
    const Box2 box = fitBox(points);
    EXPECT_GE(box.length, box.width);
    EXPECT_GT(box.centre.heading(), -0.5 * kPi - 1e-12);
    EXPECT_LE(box.centre.heading(), 0.5 * kPi);
    for (const Point2& point : points) {
      EXPECT_LT(box.distanceTo(point), 1e-9);
    }
  }
}

TEST(BoxFitTest, CoincidingPointsDoNotMatter) {
  const Box2 box = fitBox({{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}});
  EXPECT_TRUE(box.centre.position().isApprox(Point2(1.0, 1.0)));
  EXPECT_DOUBLE_EQ(box.length, 0.0);
}

}  // namespace
}  // namespace datmo
