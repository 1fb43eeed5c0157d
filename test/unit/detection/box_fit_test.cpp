// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/box_fit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::box_fit_test {
namespace {

constexpr double kSigma = 0.02;  ///< m

/// Points every 0.1 m from one point to another.
void addSide(std::vector<Point2>& points, const Point2& from, const Point2& to) {
  const int count = static_cast<int>((to - from).norm() / 0.1);
  for (int i = 0; i <= count; ++i) {
    points.push_back(from + (to - from) * (static_cast<double>(i) / count));
  }
}

/// Points on the rear and the right side, which face a scanner behind on the right.
std::vector<Point2> lShape(const Box2& box) {
  std::vector<Point2> points;
  const auto corners = box.corners();
  addSide(points, corners[1], corners[2]);
  addSide(points, corners[2], corners[3]);
  return points;
}

Point2 behindOnTheRight(const Box2& box) { return box.center * Point2(-15.0, -12.0); }

std::size_t seenSides(const BoxFit& fit) {
  std::size_t count = 0;
  for (const std::size_t points : fit.points_on_side) {
    count += points > 0 ? 1 : 0;
  }
  return count;
}

/// Rotation from one line or side to another: sides have no sign, length and width no order.
double betweenSides(double from, double to) { return std::remainder(to - from, 0.5 * kPi); }

TEST(BoxFitTest, NoPointsAreRefused) {
  EXPECT_THROW(fitBox({}, Point2::Zero(), {kSigma}), std::invalid_argument);
}

TEST(BoxFitTest, OnePointIsASideWithoutLengthAcrossTheLineOfSight) {
  const BoxFit fit = fitBox({{3.0, 3.0}}, Point2(1.0, 1.0), {kSigma});
  EXPECT_TRUE(fit.box.center.position().isApprox(Point2(3.0, 3.0)));
  EXPECT_NEAR(fit.box.center.heading(), degrees(45.0), 1e-12);
  EXPECT_DOUBLE_EQ(fit.box.length, 0.0);
  EXPECT_DOUBLE_EQ(fit.box.width, 0.0);
  EXPECT_DOUBLE_EQ(fit.heading_variance, kUnknownHeadingVariance);
  EXPECT_EQ(fit.points_on_side, (std::array<std::size_t, 4>{0, 1, 0, 0}));
}

TEST(BoxFitTest, TwoPointsAreMostLikelyOneSideButMayBeTwo) {
  const BoxFit fit = fitBox({{10.0, 0.0}, {11.0, 1.0}}, Point2::Zero(), {kSigma});
  EXPECT_NEAR(betweenSides(fit.box.center.heading(), degrees(45.0)), 0.0, 1e-9);
  EXPECT_NEAR(std::max(fit.box.length, fit.box.width), std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(std::min(fit.box.length, fit.box.width), 0.0, 1e-9);
  EXPECT_EQ(seenSides(fit), 1U);
  EXPECT_GT(fit.heading_variance, degrees(10.0) * degrees(10.0));
}

TEST(BoxFitTest, TheOrderOfThePointsDoesNotMatter) {
  // Scanners sweep to the left or to the right.
  for (double heading = -85.0; heading <= 90.0; heading += 7.0) {
    const Box2 truth{Pose2(20.0, 5.0, degrees(heading)), 4.4, 1.8};
    std::vector<Point2> points = lShape(truth);
    const BoxFit one = fitBox(points, behindOnTheRight(truth), {kSigma});
    std::reverse(points.begin(), points.end());
    const BoxFit other = fitBox(points, behindOnTheRight(truth), {kSigma});
    EXPECT_NEAR(one.box.center.heading(), other.box.center.heading(), 1e-9);
    EXPECT_TRUE(one.box.center.position().isApprox(other.box.center.position(), 1e-9));
  }
}

TEST(BoxFitTest, AnLShapeGivesTheWholeRectangleAtAnyHeading) {
  for (double heading = -88.0; heading <= 90.0; heading += 7.0) {
    const Box2 truth{Pose2(12.0, -3.0, degrees(heading)), 4.4, 1.8};
    const BoxFit fit = fitBox(lShape(truth), behindOnTheRight(truth), {kSigma});
    EXPECT_NEAR(betweenSides(truth.center.heading(), fit.box.center.heading()), 0.0, degrees(0.1))
        << heading;
    EXPECT_NEAR(std::max(fit.box.length, fit.box.width), 4.4, 0.02) << heading;
    EXPECT_NEAR(std::min(fit.box.length, fit.box.width), 1.8, 0.02) << heading;
    EXPECT_LT((fit.box.center.position() - truth.center.position()).norm(), 0.02) << heading;
    EXPECT_EQ(seenSides(fit), 2U) << heading;
  }
}

TEST(BoxFitTest, OneSideHasNoDepthButIsIdentified) {
  std::vector<Point2> points;
  addSide(points, Point2(10.0, -0.9), Point2(10.0, 0.9));
  const BoxFit from_behind = fitBox(points, Point2::Zero(), {kSigma});
  EXPECT_NEAR(from_behind.box.length, 0.0, 1e-9);
  EXPECT_NEAR(from_behind.box.width, 1.8, 1e-9);
  EXPECT_EQ(from_behind.points_on_side, (std::array<std::size_t, 4>{0, 19, 0, 0}));
  const BoxFit from_ahead = fitBox(points, Point2(20.0, 0.0), {kSigma});
  EXPECT_EQ(from_ahead.points_on_side, (std::array<std::size_t, 4>{19, 0, 0, 0}));
}

TEST(BoxFitTest, NoiseBehindASideIsNoDepth) {
  Random random(2);
  std::vector<Point2> points;
  addSide(points, Point2(10.0, -0.9), Point2(10.0, 0.9));
  for (Point2& point : points) {
    point.x() += random.normal(kSigma);
  }
  const BoxFit fit = fitBox(points, Point2::Zero(), {kSigma});
  EXPECT_EQ(seenSides(fit), 1U);
  EXPECT_LT(std::min(fit.box.length, fit.box.width), 1e-9);
}

TEST(BoxFitTest, HeadingVarianceOfALineIsThatOfTheRegression) {
  // n points of standard deviation s over a length: s^2 / sum (x - mean)^2, the noise known.
  std::vector<Point2> points;
  addSide(points, Point2(10.0, -2.0), Point2(10.0, 2.0));
  double squares = 0.0;
  for (const Point2& point : points) {
    squares += point.y() * point.y();
  }
  const BoxFit fit = fitBox(points, Point2::Zero(), {0.2});
  constexpr double kFloor = 1e-4;  // rad^2
  EXPECT_NEAR(fit.heading_variance, kFloor + fit.noise * fit.noise / squares, 1e-5);
  EXPECT_LT(fit.noise, 0.2) << "the points lie on the line better than was expected";
}

TEST(BoxFitTest, AnOutlierDoesNotTurnTheBox) {
  const Box2 truth{Pose2(12.0, -3.0, degrees(20.0)), 4.4, 1.8};
  std::vector<Point2> points = lShape(truth);
  points.push_back(truth.center * Point2(0.3, 0.2));  // through a window
  const BoxFit fit = fitBox(points, behindOnTheRight(truth), {kSigma});
  EXPECT_NEAR(betweenSides(truth.center.heading(), fit.box.center.heading()), 0.0, degrees(0.2));
}

TEST(BoxFitTest, NoisyHeadingsAreAsGoodAsTheirVariance) {
  Random random(5);
  constexpr double kNoise = 0.05;
  double squares = 0.0;
  int far_off = 0;
  constexpr int kRuns = 500;
  for (int i = 0; i < kRuns; ++i) {
    const Box2 truth{Pose2(12.0, -3.0, random.uniform(-kPi, kPi)), 4.4, 1.8};
    std::vector<Point2> points = lShape(truth);
    for (Point2& point : points) {
      point += Point2(random.normal(kNoise), random.normal(kNoise));
    }
    const BoxFit fit = fitBox(points, behindOnTheRight(truth), {kNoise});
    const double error = betweenSides(truth.center.heading(), fit.box.center.heading());
    squares += error * error / fit.heading_variance;
    far_off += error * error > 9.0 * fit.heading_variance ? 1 : 0;
  }
  EXPECT_LT(squares / kRuns, 1.2);
  EXPECT_GT(squares / kRuns, 0.02) << "a floor on the variance makes it small, nothing else";
  EXPECT_LE(far_off, kRuns / 100);
}

/// Mean of the squared heading error over its variance, for sides of 30 points that share their
/// noise in groups of five.
double headingNees(double correlated_points) {
  constexpr double kNoise = 0.05;
  constexpr std::size_t kBlock = 5;
  constexpr int kRuns = 400;
  Random random(7);
  double squares = 0.0;
  for (int i = 0; i < kRuns; ++i) {
    std::vector<Point2> points;
    addSide(points, Point2(10.0, -1.5), Point2(10.0, 1.5));
    double shared = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      shared = k % kBlock == 0 ? random.normal(kNoise) : shared;
      points[k].x() += shared;
    }
    const BoxFit fit = fitBox(points, Point2::Zero(), {kNoise, correlated_points});
    const double error = betweenSides(0.0, fit.box.center.heading());
    squares += error * error / fit.heading_variance;
  }
  return squares / kRuns;
}

TEST(BoxFitTest, CorrelatedNoiseReducesTheInformationOnTheHeading) {
  EXPECT_GT(headingNees(1.0), 2.0) << "taken for independent";
  EXPECT_LT(headingNees(5.0), 1.3);
  EXPECT_GT(headingNees(5.0), 0.2) << "it is honest, if cautious";
}

TEST(BoxFitTest, WithoutAHeadingTheBoxIsAcrossTheLineOfSight) {
  // Seen along the diagonal: ends at right angles to it, the depth is the mean one.
  const Point2 scanner(1.0, 2.0);
  const std::vector<Point2> points = {scanner + Point2(9.0, 10.0), scanner + Point2(10.0, 10.0),
                                      scanner + Point2(11.0, 10.0)};
  const BoxFit fit = boxAcross(points, scanner, kSigma);
  EXPECT_NEAR(fit.box.center.heading(), degrees(45.0), 1e-9);
  EXPECT_DOUBLE_EQ(fit.box.length, 0.0);
  EXPECT_NEAR(fit.box.width, std::sqrt(2.0), 1e-9);
  EXPECT_TRUE(fit.box.center.position().isApprox(scanner + Point2(10.0, 10.0), 1e-9));
  EXPECT_DOUBLE_EQ(fit.heading_variance, kUnknownHeadingVariance);
  EXPECT_EQ(fit.points_on_side, (std::array<std::size_t, 4>{0, 3, 0, 0}));
  EXPECT_THROW(boxAcross({}, scanner, kSigma), std::invalid_argument);
}

TEST(BoxFitTest, AnyPointsGiveAFiniteBox) {
  const double kDiagonal = std::hypot(6.0, 6.0) + 1e-9;
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    std::vector<Point2> points;
    for (int k = 0; k < 1 + i % 10; ++k) {
      points.emplace_back(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    }
    const BoxFit fit = fitBox(points, Point2(random.uniform(-5.0, 5.0), 0.0), {kSigma});
    EXPECT_TRUE(std::isfinite(fit.box.center.x() + fit.box.center.y()));
    EXPECT_GE(fit.box.length, 0.0);
    EXPECT_GE(fit.box.width, 0.0);
    EXPECT_LE(std::max(fit.box.length, fit.box.width), kDiagonal) << "of the square they lie in";
    EXPECT_GT(fit.heading_variance, 0.0);
    EXPECT_LE(fit.heading_variance, kUnknownHeadingVariance);
    EXPECT_GE(seenSides(fit), 1U);
  }
}

TEST(BoxFitTest, CoincidingPointsDoNotMatter) {
  const BoxFit fit = fitBox({{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}}, Point2::Zero(), {kSigma});
  EXPECT_TRUE(fit.box.center.position().isApprox(Point2(1.0, 1.0)));
  EXPECT_DOUBLE_EQ(fit.box.length, 0.0);
  EXPECT_DOUBLE_EQ(fit.heading_variance, kUnknownHeadingVariance);
}

}  // namespace
}  // namespace datmo::box_fit_test
