// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/scan_matcher.h"

#include "grid/small_map.h"
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace datmo::scan_matcher_test {
namespace {

/// Points along a wall, every 0.2 m.
void addWall(std::vector<Point2>& points, const Point2& from, const Point2& to) {
  const int count = static_cast<int>((to - from).norm() / 0.2);
  for (int i = 0; i <= count; ++i) {
    points.push_back(from + (to - from) * (static_cast<double>(i) / count));
  }
}

/// Two walls that meet in a corner, ahead of the origin and to the left.
std::vector<Point2> corner() {
  std::vector<Point2> points;
  addWall(points, {8.13, -6.0}, {8.13, 6.07});
  addWall(points, {-6.0, 6.07}, {8.13, 6.07});
  return points;
}

std::vector<Point2> corridor() {
  std::vector<Point2> points;
  addWall(points, {-12.0, 3.04}, {12.0, 3.04});
  addWall(points, {-12.0, -3.11}, {12.0, -3.11});
  return points;
}

/// One scan of the points from this pose.
Scan scanOfPoints(const std::vector<Point2>& points, const Pose2& pose) {
  std::vector<Point2> ends;
  for (const Point2& point : points) {
    ends.push_back(pose.inverse() * point);
  }
  return samples::scanWithSpacing(degrees(1.0), ends);
}

OccupancyMap emptyMap() {
  OccupancyMapOptions options;
  options.window.length = 40.0;
  options.window.width = 40.0;
  return OccupancyMap(options);
}

/// Adds the points, seen from the origin, `times` times from this time on, every 0.1 s.
void see(OccupancyMap& map, const std::vector<Point2>& points, double from, int times) {
  Scan scan = scanOfPoints(points, {});
  for (int i = 0; i < times; ++i) {
    scan.stamp = Stamp::fromSeconds(from + 0.1 * i);
    map.update(scan, std::vector<PointState>(points.size(), PointState::kUnknown), {});
  }
}

/// Returns the map after the points were seen several times.
OccupancyMap mapOf(const std::vector<Point2>& points) {
  OccupancyMap map = emptyMap();
  see(map, points, 10.0, 5);
  return map;
}

std::vector<EndPoint> seenFrom(const std::vector<Point2>& points, const Pose2& pose) {
  return endPoints(scanOfPoints(points, pose), 1.0);
}

Eigen::Matrix3d priorCovariance() {
  return Eigen::Vector3d(0.3 * 0.3, 0.3 * 0.3, 0.05 * 0.05).asDiagonal();
}

Prediction prior() { return {{Pose2(), priorCovariance()}}; }

TEST(ScanMatcherTest, FindsTheShiftFromAllSidesBelowACell) {
  const std::vector<Point2> points = corner();
  const OccupancyMap map = mapOf(points);
  const ScanMatcher matcher(ScanMatcherOptions{});
  Random random(1);
  for (const double x : {-0.4, 0.0, 0.4}) {
    for (const double y : {-0.4, 0.0, 0.4}) {
      for (const double heading : {-0.04, 0.0, 0.04}) {
        const Pose2 truth(x, y, heading);
        const MatchResult result = matcher.match(map, seenFrom(points, truth), prior(), random);
        ASSERT_TRUE(result.quality.accepted);
        EXPECT_NEAR(result.pose.pose.x(), x, 0.05);
        EXPECT_NEAR(result.pose.pose.y(), y, 0.05);
        EXPECT_NEAR(result.pose.pose.heading(), heading, 0.01);
      }
    }
  }
}

TEST(ScanMatcherTest, RefinementIsBetterThanTheBestSample) {
  const std::vector<Point2> points = corner();
  const OccupancyMap map = mapOf(points);
  ScanMatcherOptions plain;
  plain.refinement_steps = 0;
  double plain_error = 0.0;
  double refined_error = 0.0;
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Pose2 truth(0.02 * i, -0.015 * i, 0.001 * i);
    const auto seen = seenFrom(points, truth);
    const auto error = [&](const ScanMatcherOptions& options) {
      const MatchResult result = ScanMatcher(options).match(map, seen, prior(), random);
      return (result.pose.pose.position() - truth.position()).norm();
    };
    plain_error += error(plain);
    refined_error += error(ScanMatcherOptions{});
  }
  EXPECT_LT(refined_error, 0.5 * plain_error);
}

TEST(ScanMatcherTest, AlongACorridorPredictionAndCovarianceAreKept) {
  const std::vector<Point2> points = corridor();
  const OccupancyMap map = mapOf(points);
  Random random(1);
  const Pose2 truth(0.0, 0.25, 0.01);
  const MatchResult result =
      ScanMatcher(ScanMatcherOptions{}).match(map, seenFrom(points, truth), prior(), random);
  EXPECT_NEAR(result.pose.pose.y(), 0.25, 0.05);
  EXPECT_GT(std::sqrt(result.pose.covariance(0, 0)), 2.0 * std::sqrt(result.pose.covariance(1, 1)));
}

TEST(ScanMatcherTest, ACorridorsDirectionIsLeftToThePrediction) {
  // The map knows another part of the corridor's walls than the scan sees: only the walls' sides
  // are informative.
  const OccupancyMap map = mapOf(corridor());
  std::vector<Point2> seen;
  addWall(seen, {-5.0, 3.04}, {4.3, 3.04});
  addWall(seen, {-4.1, -3.11}, {5.2, -3.11});
  Random random(1);
  const MatchResult result = ScanMatcher(ScanMatcherOptions{})
                                 .match(map, seenFrom(seen, {0.3, 0.2, 0.0}), prior(), random);
  EXPECT_TRUE(result.quality.accepted);
  EXPECT_TRUE(result.quality.degenerate);
  EXPECT_GT(result.quality.weakest_sigma, ScanMatcherOptions{}.degenerate_sigma);
  EXPECT_NEAR(result.pose.pose.x(), 0.0, 1e-3);
  EXPECT_NEAR(result.pose.pose.y(), 0.2, 0.05);
  EXPECT_NEAR(result.pose.covariance(0, 0), priorCovariance()(0, 0), 1e-3);
  EXPECT_LT(result.pose.covariance(1, 1), 0.1 * priorCovariance()(1, 1));
}

TEST(ScanMatcherTest, ACornerConstrainsAllDirections) {
  const std::vector<Point2> points = corner();
  const OccupancyMap map = mapOf(points);
  Random random(1);
  const MatchQuality quality =
      ScanMatcher(ScanMatcherOptions{}).match(map, seenFrom(points, {}), prior(), random).quality;
  EXPECT_FALSE(quality.degenerate);
  EXPECT_LT(quality.weakest_sigma, 0.1);
}

TEST(ScanMatcherTest, MoversInTheScanDoNotPullThePose) {
  const std::vector<Point2> points = corner();
  const OccupancyMap map = mapOf(points);
  std::vector<Point2> seen = points;
  addWall(seen, {3.0, -1.0}, {3.0, 1.0});
  addWall(seen, {7.2, -5.0}, {7.2, -3.5});
  Random random(1);
  const MatchResult result =
      ScanMatcher(ScanMatcherOptions{}).match(map, seenFrom(seen, {}), prior(), random);
  EXPECT_LT(result.pose.pose.position().norm(), 0.05);
}

/// Shift of the pose along a corridor, m, if the rear of a car that has just come into view is 0.3
/// m further than the map has it: -0.3 m if it is taken for static.
double shiftByNewcomer(double min_maturity, bool measured) {
  OccupancyMap map = emptyMap();
  see(map, corridor(), 10.0, 12);
  std::vector<Point2> rear;
  addWall(rear, {6.1, -1.0}, {6.1, 1.0});
  see(map, rear, 11.2, 1);
  std::vector<Point2> seen;
  addWall(seen, {-5.0, 3.04}, {4.3, 3.04});
  addWall(seen, {6.4, -1.0}, {6.4, 1.0});
  addWall(seen, {-4.1, -3.11}, {5.2, -3.11});
  ScanMatcherOptions options;
  options.min_maturity = min_maturity;
  Prediction prediction = prior();
  prediction.measured = measured;
  Random random(1);
  return ScanMatcher(options).match(map, seenFrom(seen, {}), prediction, random).pose.pose.x();
}

TEST(ScanMatcherTest, NewlyVisiblePointsDoNotPullThePose) {
  EXPECT_NEAR(shiftByNewcomer(ScanMatcherOptions{}.min_maturity, true), 0.0, 0.02);
  EXPECT_LT(shiftByNewcomer(1.0, true), -0.15) << "all alike";
}

TEST(ScanMatcherTest, WithoutOdometryNewlyVisiblePointsCount) {
  EXPECT_LT(shiftByNewcomer(ScanMatcherOptions{}.min_maturity, false), -0.15);
}

TEST(ScanMatcherTest, WithoutAMapThePredictionIsTheAnswer) {
  const OccupancyMap map{OccupancyMapOptions{}};
  Random random(1);
  const PoseWithCovariance prediction{Pose2(1.0, 2.0, 0.3), priorCovariance()};
  const MatchResult result =
      ScanMatcher(ScanMatcherOptions{}).match(map, seenFrom(corner(), {}), {prediction}, random);
  EXPECT_FALSE(result.quality.accepted);
  EXPECT_EQ(result.pose.pose.position(), prediction.pose.position());
  EXPECT_TRUE(result.pose.covariance.isApprox(prediction.covariance));
}

TEST(ScanMatcherTest, AScanWithoutPointsIsNoMatch) {
  const OccupancyMap map = mapOf(corner());
  Random random(1);
  EXPECT_FALSE(ScanMatcher(ScanMatcherOptions{}).match(map, {}, prior(), random).quality.accepted);
}

TEST(ScanMatcherTest, TheCovarianceIsPositiveDefiniteAndBelowThePrior) {
  const std::vector<Point2> points = corner();
  const OccupancyMap map = mapOf(points);
  Random random(1);
  const Eigen::Matrix3d covariance = ScanMatcher(ScanMatcherOptions{})
                                         .match(map, seenFrom(points, {}), prior(), random)
                                         .pose.covariance;
  EXPECT_GT(covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
  const Eigen::Matrix3d gain = priorCovariance() - covariance;
  EXPECT_GT(gain.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
}

}  // namespace
}  // namespace datmo::scan_matcher_test
