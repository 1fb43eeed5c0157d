// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/static_scan.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo::static_scan_test {
namespace {

ScanPoint pointOf(std::uint32_t beam, double range, PointState state) {
  return {Point2(range, static_cast<double>(beam)), range, 0.0, beam, state};
}

/// Beam 0 ends on a wall, 1 on a moving car, 2 in unknown space, 3 has no return, 4 is blind.
LabeledScan fiveBeams() {
  LabeledScan scan;
  scan.field.beams = 5;
  scan.field.beam_spacing = 0.1;
  scan.field.free_range = 40.0;
  scan.field.range = 50.0;
  scan.points = {pointOf(0, 10.0, PointState::kStatic), pointOf(1, 11.0, PointState::kMoving),
                 pointOf(2, 12.0, PointState::kUnknown)};
  scan.blind_beams = {4};
  return scan;
}

TEST(StaticRanges, MarkStaticPointsAndClearFreeSpace) {
  const auto ranges = staticRanges(fiveBeams(), true);
  ASSERT_EQ(ranges.size(), 5U);
  EXPECT_EQ(ranges[0], 10.0F);
  EXPECT_TRUE(std::isnan(ranges[1])) << "a mover neither marks nor clears";
  EXPECT_EQ(ranges[2], 12.0F);
  EXPECT_TRUE(std::isinf(ranges[3]) && ranges[3] > 0.0F);
  EXPECT_TRUE(std::isnan(ranges[4]));
}

TEST(StaticRanges, UnknownPointsAreLeftOutOnRequest) {
  EXPECT_TRUE(std::isnan(staticRanges(fiveBeams(), false)[2]));
}

TEST(StaticRanges, WithoutAFreeRangeABeamWithoutReturnIsUninformative) {
  LabeledScan scan = fiveBeams();
  scan.field.free_range = 0.0;
  EXPECT_TRUE(std::isnan(staticRanges(scan, true)[3]));
}

TEST(StaticRanges, BeyondItsFreeRangeABeamWithoutReturnIsUninformative) {
  LabeledScan scan = fiveBeams();
  EXPECT_EQ(staticRange(scan.field), 40.0);
  scan.points = {pointOf(0, 45.0, PointState::kStatic)};
  EXPECT_TRUE(std::isnan(staticRanges(scan, true)[0]));
  scan.field.free_range = 0.0;
  EXPECT_EQ(staticRange(scan.field), 50.0);
  EXPECT_EQ(staticRanges(scan, true)[0], 45.0F);
}

TEST(StaticRanges, TheNearestEndPointOfABeamDecides) {
  LabeledScan scan = fiveBeams();
  scan.points = {pointOf(0, 10.0, PointState::kStatic), pointOf(0, 6.0, PointState::kMoving),
                 pointOf(1, 11.0, PointState::kMoving), pointOf(1, 7.0, PointState::kStatic)};
  const auto ranges = staticRanges(scan, true);
  EXPECT_TRUE(std::isnan(ranges[0])) << "a mover is before the wall";
  EXPECT_EQ(ranges[1], 7.0F);
}

TEST(StaticRanges, BeamsBeyondTheFieldAreLeftOut) {
  LabeledScan scan = fiveBeams();
  scan.points.push_back(pointOf(5, 3.0, PointState::kStatic));
  scan.blind_beams.push_back(6);
  EXPECT_EQ(staticRanges(scan, true).size(), 5U);
  scan.field.beams = 0;
  EXPECT_TRUE(staticRanges(scan, true).empty());
}

TEST(StaticPoints, AreTheStaticOnes) {
  EXPECT_EQ(staticPoints(fiveBeams(), true).size(), 2U);
  const auto known = staticPoints(fiveBeams(), false);
  ASSERT_EQ(known.size(), 1U);
  EXPECT_EQ(known.front(), Point2(10.0, 0.0));
}

}  // namespace
}  // namespace datmo::static_scan_test
