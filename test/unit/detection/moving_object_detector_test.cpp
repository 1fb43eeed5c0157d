#include "datmo_fusion/detection/moving_object_detector.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace datmo {
namespace {

/// A scan of 2-degree beams; each entry is range, beam index and state.
struct End {
  double range;
  std::uint32_t beam;
  PointState state;
};

SplitScan splitScan(const std::vector<End>& ends) {
  SplitScan scan;
  scan.stamp = Stamp::fromSeconds(5.0);
  for (const End& end : ends) {
    ScanPoint point;
    point.range = end.range;
    point.beam = end.beam;
    point.bearing = degrees(-80.0 + 2.0 * end.beam);
    point.position = end.range * Point2(std::cos(point.bearing), std::sin(point.bearing));
    point.state = end.state;
    scan.points.push_back(point);
  }
  return scan;
}

constexpr PointState kS = PointState::kStatic;
constexpr PointState kM = PointState::kMoving;
constexpr PointState kU = PointState::kUnknown;

ObjectList detect(const SplitScan& scan, const MovingObjectDetectorOptions& options = {}) {
  return MovingObjectDetector(options).detect(scan);
}

/// Variance across the line of sight of the first object of a scan.
double varianceAcross(const SplitScan& scan) {
  const Object object = detect(scan).objects.at(0);
  const Point2 sight = object.box.centre.position().normalized();
  const Point2 across(-sight.y(), sight.x());
  return across.dot(object.position_covariance * across);
}

TEST(MovingObjectDetectorTest, AScanOfMoreThanHalfATurnHasTheSameBeamSpacing) {
  const End object{40.0, 10, kM};
  const double narrow = varianceAcross(splitScan({object, {20.0, 60, kS}, {20.0, 80, kS}}));
  const double wide = varianceAcross(
      splitScan({object, {20.0, 60, kS}, {20.0, 110, kS}, {20.0, 160, kS}}));  // 300 degrees
  EXPECT_NEAR(wide, narrow, 1e-9);
}

TEST(MovingObjectDetectorTest, AnEmptyScanHasNoObjects) {
  const ObjectList list = detect(splitScan({}));
  EXPECT_TRUE(list.objects.empty());
  EXPECT_EQ(list.stamp, Stamp::fromSeconds(5.0));
}

TEST(MovingObjectDetectorTest, WhatIsStaticIsNoObject) {
  EXPECT_TRUE(detect(splitScan({{10.0, 40, kS}, {10.0, 41, kS}})).objects.empty());
}

TEST(MovingObjectDetectorTest, MovingAndUnknownSegmentsAreTold) {
  const ObjectList list =
      detect(splitScan({{10.0, 10, kM}, {10.0, 11, kM}, {20.0, 40, kU}, {20.0, 41, kU}}));
  ASSERT_EQ(list.objects.size(), 2U);
  EXPECT_EQ(list.objects[0].dynamic_state, DynamicState::kMoving);
  EXPECT_DOUBLE_EQ(list.objects[0].moving_fraction, 1.0);
  EXPECT_EQ(list.objects[1].dynamic_state, DynamicState::kUnknown);
  EXPECT_EQ(list.objects[0].points.size(), 2U);
  EXPECT_EQ(list.objects[0].sensors, std::vector<std::string>{"lidar"});
}

TEST(MovingObjectDetectorTest, AScannerThatTurnsToTheRightSeesTheSameObjects) {
  const SplitScan left = splitScan({{12.0, 10, kM},
                                    {11.9, 11, kM},
                                    {20.0, 40, kU},
                                    {20.5, 41, kU},
                                    {21.2, 42, kM},
                                    {30.0, 60, kS}});
  SplitScan right = left;
  std::reverse(right.points.begin(), right.points.end());
  for (ScanPoint& point : right.points) {
    point.beam = 80 - point.beam;
  }
  const ObjectList expected = detect(left);
  ObjectList list = detect(right);
  ASSERT_EQ(expected.objects.size(), 2U);
  ASSERT_EQ(list.objects.size(), 2U);
  std::reverse(list.objects.begin(), list.objects.end());
  for (std::size_t i = 0; i < 2; ++i) {
    const Object& one = expected.objects[i];
    const Object& other = list.objects[i];
    EXPECT_EQ(one.dynamic_state, other.dynamic_state);
    EXPECT_TRUE(one.box.centre.position().isApprox(other.box.centre.position(), 1e-9));
    EXPECT_NEAR(one.box.centre.heading(), other.box.centre.heading(), 1e-9);
    EXPECT_NEAR(one.box.length, other.box.length, 1e-9);
    EXPECT_TRUE(one.position_covariance.isApprox(other.position_covariance, 1e-9));
  }
}

TEST(MovingObjectDetectorTest, TheThesisTakesAnyMovingPoint) {
  const SplitScan scan =
      splitScan({{10.0, 40, kM}, {10.0, 41, kU}, {10.0, 42, kU}, {10.0, 43, kU}});
  EXPECT_EQ(detect(scan).objects.at(0).dynamic_state, DynamicState::kUnknown);
  MovingObjectDetectorOptions thesis;
  thesis.moving_share = 0.0;
  EXPECT_EQ(detect(scan, thesis).objects.at(0).dynamic_state, DynamicState::kMoving);
}

TEST(MovingObjectDetectorTest, AStaticPointNextToAMoverDoesNotHideIt) {
  const ObjectList list = detect(splitScan({{10.0, 40, kM}, {10.2, 41, kS}, {10.1, 42, kM}}));
  ASSERT_EQ(list.objects.size(), 1U);
  EXPECT_EQ(list.objects[0].points.size(), 2U);
}

TEST(MovingObjectDetectorTest, WhatJoinsOnToAWallIsPartOfIt) {
  const ObjectList list =
      detect(splitScan({{10.0, 40, kU}, {10.0, 41, kU}, {10.0, 42, kS}, {10.0, 43, kS}}));
  ASSERT_EQ(list.objects.size(), 1U);
  EXPECT_EQ(list.objects[0].dynamic_state, DynamicState::kStatic);
  EXPECT_EQ(list.objects[0].points.size(), 2U);
}

TEST(MovingObjectDetectorTest, WhatMovesNextToAWallStillMoves) {
  const ObjectList list =
      detect(splitScan({{10.0, 40, kM}, {10.0, 41, kM}, {10.0, 42, kS}, {10.0, 43, kS}}));
  ASSERT_EQ(list.objects.size(), 1U);
  EXPECT_EQ(list.objects[0].dynamic_state, DynamicState::kMoving);
}

TEST(MovingObjectDetectorTest, AHedgeIsNoObject) {
  std::vector<End> hedge;
  for (std::uint32_t beam = 0; beam < 81; ++beam) {
    hedge.push_back({15.0, beam, kU});
  }
  EXPECT_TRUE(detect(splitScan(hedge)).objects.empty());
}

TEST(MovingObjectDetectorTest, TheCovarianceIsLongerAcrossTheBeamsFarAway) {
  // Beam 40 looks along x.
  const Eigen::Matrix2d near =
      detect(splitScan({{5.0, 40, kM}, {5.0, 41, kM}})).objects.at(0).position_covariance;
  const Eigen::Matrix2d far =
      detect(splitScan({{40.0, 40, kM}, {40.0, 41, kM}})).objects.at(0).position_covariance;
  EXPECT_GT(near.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
  EXPECT_GT(far(1, 1), far(0, 0));
  EXPECT_GT(far(1, 1), near(1, 1));
  // Across: a uniform interval of one beam spacing, and the object's extent.
  const double across = 40.0 * degrees(2.0);
  EXPECT_NEAR(far(1, 1), across * across / 12.0 + 0.3 * 0.3, 0.01);
}

TEST(MovingObjectDetectorTest, HeadingIsSurerTheLongerTheObject) {
  const double pair =
      detect(splitScan({{10.0, 40, kM}, {10.0, 41, kM}})).objects[0].heading_variance;
  const double wide =
      detect(splitScan(
                 {{10.0, 38, kM}, {10.0, 39, kM}, {10.0, 40, kM}, {10.0, 41, kM}, {10.0, 42, kM}}))
          .objects[0]
          .heading_variance;
  EXPECT_LT(wide, pair);
}

TEST(MovingObjectDetectorTest, RefusesBadOptions) {
  MovingObjectDetectorOptions options;
  options.segmentation.longest_gap = -2.0;
  EXPECT_THROW(MovingObjectDetector{options}, OptionError);
}

}  // namespace
}  // namespace datmo
