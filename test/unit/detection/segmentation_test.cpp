// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/segmentation.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo::segmentation_test {
namespace {

ScanPoint polar(double range, double bearing_degrees) {
  ScanPoint point;
  point.range = range;
  point.bearing = degrees(bearing_degrees);
  point.position = range * Point2(std::cos(point.bearing), std::sin(point.bearing));
  return point;
}

SegmentationOptions fixedGap(double gap) {
  SegmentationOptions options;
  options.adaptive = false;
  options.max_gap = gap;
  return options;
}

TEST(SegmentationTest, NoPointsNoSegments) {
  EXPECT_TRUE(segmentPoints({}, SegmentationOptions{}).empty());
}

TEST(SegmentationTest, TheLongestGapHoldsWhereTheShortestIsSetLonger) {
  SegmentationOptions options;
  options.max_gap = 0.3;
  options.min_gap = 0.6;
  EXPECT_EQ(segmentPoints({polar(10.0, 0.0), polar(10.4, 0.0)}, options).size(), 2U);
  EXPECT_EQ(segmentPoints({polar(10.0, 0.0), polar(10.2, 0.0)}, options).size(), 1U);
}

TEST(SegmentationTest, CutsWhereNeighborsAreTooFarApart) {
  const std::vector<ScanPoint> points = {polar(10.0, 0.0), polar(10.0, 2.0), polar(13.0, 4.0),
                                         polar(13.0, 6.0)};
  const auto segments = segmentPoints(points, fixedGap(2.0));
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0], (Segment{0, 1}));
  EXPECT_EQ(segments[1], (Segment{2, 3}));
}

TEST(SegmentationTest, TheGapItselfIsACut) {
  const std::vector<ScanPoint> points = {polar(10.0, 0.0), polar(12.0, 0.0)};
  EXPECT_EQ(segmentPoints(points, fixedGap(2.0)).size(), 2U);
  EXPECT_EQ(segmentPoints(points, fixedGap(2.01)).size(), 1U);
}

TEST(SegmentationTest, EveryPointIsInOneSegmentInOrder) {
  std::vector<ScanPoint> points;
  for (int i = 0; i < 81; ++i) {
    points.push_back(polar(5.0 + (i * 7) % 11, -80.0 + 2.0 * i));
  }
  std::size_t next = 0;
  for (const Segment& segment : segmentPoints(points, SegmentationOptions{})) {
    for (const std::size_t index : segment) {
      EXPECT_EQ(index, next++);
    }
  }
  EXPECT_EQ(next, points.size());
}

TEST(SegmentationTest, AdaptiveKeepsAFarWallWholeAndANearGapApart) {
  SegmentationOptions options;
  const std::vector<ScanPoint> wall = {polar(30.0, 0.0), polar(30.0, 2.0), polar(30.0, 4.0)};
  EXPECT_EQ(segmentPoints(wall, options).size(), 1U);
  // 1.5 m apart at 4 m range: two people, not one.
  const std::vector<ScanPoint> people = {polar(4.0, 0.0), polar(5.5, 2.0)};
  EXPECT_EQ(segmentPoints(people, options).size(), 2U);
  EXPECT_EQ(segmentPoints(people, fixedGap(2.0)).size(), 1U);
}

TEST(SegmentationTest, AdaptiveGapFollowsItsFormulaAndItsLimits) {
  SegmentationOptions options;
  options.min_gap = 0.1;
  options.max_gap = 2.0;
  options.min_incidence = 0.5;
  const double angle = degrees(2.0);
  const double gap = 0.1 + 10.0 * std::sin(angle) / std::sin(0.5 - angle);
  ASSERT_LT(gap, 2.0);
  const auto apart = [&](double distance) {
    // A second point at the bearing of the next beam and this far from the first one.
    const double range = 10.0 * std::cos(angle) +
                         std::sqrt(distance * distance - std::pow(10.0 * std::sin(angle), 2));
    return segmentPoints({polar(10.0, 0.0), polar(range, 2.0)}, options).size();
  };
  EXPECT_EQ(apart(gap - 0.01), 1U);
  EXPECT_EQ(apart(gap + 0.01), 2U);
  EXPECT_EQ(segmentPoints({polar(60.0, 0.0), polar(60.0, 2.0)}, options).size(), 2U)
      << "2.09 m apart: over the longest gap";
}

}  // namespace
}  // namespace datmo::segmentation_test
