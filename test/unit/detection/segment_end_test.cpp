// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/segment_end.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo::segment_end_test {
namespace {

constexpr double kSpacing = 0.01;  ///< rad
constexpr double kSigma = 0.05;    ///< m
constexpr double kMaxGap = 2.0;
constexpr std::uint32_t kLast = 5;
constexpr double kRange = 10.0;

ScanPoint pointOf(std::uint32_t beam, double range, double spacing = kSpacing) {
  const double bearing = spacing * (static_cast<double>(beam) - kLast);
  return {range * Point2(std::cos(bearing), std::sin(bearing)), range, bearing, beam,
          PointState::kMoving};
}

/// Beams 0 to 9; beam 5 looks along x and ends at 10 m.
LabeledScan scanWithLast() {
  LabeledScan scan;
  scan.field = {-kLast * kSpacing, kSpacing, 10, 0.5, 40.0, 80.0};
  scan.points = {pointOf(kLast, kRange)};
  return scan;
}

std::optional<SurfaceEnd> leftEnd(const LabeledScan& scan, const Point2& along = Point2(0.0, 1.0)) {
  return SegmentEnds(scan, kSigma, kMaxGap).beyond(scan.points.front(), along, 0.0);
}

TEST(SegmentEndTest, ASurfaceAcrossTheBeamsEndsHalfASpacingOnIfTheNextBeamGoesBy) {
  const auto end = leftEnd(scanWithLast());
  ASSERT_TRUE(end);
  const double gap = kRange * std::tan(kSpacing);
  EXPECT_NEAR(end->beyond, 0.5 * gap, 1e-12);
  EXPECT_NEAR(end->variance, gap * gap / 12.0, 1e-12);
}

TEST(SegmentEndTest, AtAFlatAngleTheGapIsLong) {
  const double incidence = degrees(20.0);
  const Point2 along(std::cos(incidence), std::sin(incidence));
  const auto end = leftEnd(scanWithLast(), along);
  ASSERT_TRUE(end);
  // Sine rule in the triangle scanner, last point, next point.
  const double gap = kRange * std::sin(kSpacing) / std::sin(incidence - kSpacing);
  EXPECT_NEAR(end->beyond, 0.5 * gap, 1e-9);
  const double slant = kSigma * std::cos(incidence);
  EXPECT_NEAR(end->variance, gap * gap / 12.0 + slant * slant, 1e-9);
}

TEST(SegmentEndTest, AnUncertainDirectionMakesTheEndUncertain) {
  const LabeledScan scan = scanWithLast();
  const Point2 along(std::cos(0.5), std::sin(0.5));
  const SegmentEnds ends(scan, kSigma, kMaxGap);
  const auto exact = ends.beyond(scan.points.front(), along, 0.0);
  const auto vague = ends.beyond(scan.points.front(), along, 0.2);
  ASSERT_TRUE(exact && vague);
  EXPECT_DOUBLE_EQ(vague->beyond, exact->beyond);
  EXPECT_GT(vague->variance, 2.0 * exact->variance);
}

TEST(SegmentEndTest, ASurfaceAlongTheBeamsHasNoKnownEnd) {
  EXPECT_FALSE(leftEnd(scanWithLast(), Point2(1.0, 0.0)));
  EXPECT_FALSE(leftEnd(scanWithLast(), Point2(std::cos(0.005), std::sin(0.005))))
      << "the next beam never meets it";
}

TEST(SegmentEndTest, SomethingNearerHidesTheEnd) {
  LabeledScan scan = scanWithLast();
  scan.points.push_back(pointOf(kLast + 1, 6.0));
  EXPECT_FALSE(leftEnd(scan));
  scan.points.back() = pointOf(kLast + 1, 20.0);
  EXPECT_TRUE(leftEnd(scan)) << "what is behind does not";
}

TEST(SegmentEndTest, AContinuingSurfaceHasNotEnded) {
  LabeledScan scan = scanWithLast();
  scan.points.push_back(pointOf(kLast + 1, kRange + 2.0 * kSigma));
  EXPECT_FALSE(leftEnd(scan));
}

TEST(SegmentEndTest, OnlyTheBeamOnThatSideCounts) {
  LabeledScan scan = scanWithLast();
  scan.points.insert(scan.points.begin(), pointOf(kLast - 1, 6.0));
  const SegmentEnds ends(scan, kSigma, kMaxGap);
  EXPECT_TRUE(ends.beyond(scan.points[1], Point2(0.0, 1.0), 0.0));
  EXPECT_FALSE(ends.beyond(scan.points[1], Point2(0.0, -1.0), 0.0));
}

TEST(SegmentEndTest, WithoutReturnItIsSeenAsFarAsTheBeamIsKnownFree) {
  LabeledScan scan = scanWithLast();
  scan.field.free_range = 9.0;
  EXPECT_FALSE(leftEnd(scan));
  scan.field.free_range = 11.0;
  EXPECT_TRUE(leftEnd(scan));
}

TEST(SegmentEndTest, TheEdgeOfTheFieldAndABlindBeamHideTheEnd) {
  LabeledScan scan = scanWithLast();
  scan.blind_beams = {kLast + 1};
  EXPECT_FALSE(leftEnd(scan));
  scan.blind_beams = {kLast - 1};
  EXPECT_TRUE(leftEnd(scan));
  scan.field.beams = kLast + 1;
  EXPECT_FALSE(leftEnd(scan));
  scan.field.beams = 0;
  EXPECT_FALSE(leftEnd(scan)) << "nothing is known of the field";
}

TEST(SegmentEndTest, AScannerThatTurnsToTheRightSeesTheSameEnds) {
  LabeledScan scan = scanWithLast();
  scan.field.beam_spacing = -kSpacing;
  scan.points.push_back(pointOf(kLast + 1, 6.0, -kSpacing));  // to the right
  EXPECT_TRUE(leftEnd(scan));
  EXPECT_FALSE(leftEnd(scan, Point2(0.0, -1.0)));
}

}  // namespace
}  // namespace datmo::segment_end_test
