// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/visibility/scan_support.h"

#include <cmath>
#include <cstdint>

#include "fusion/fusion_objects.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::scan_support_test {
namespace {

constexpr std::uint32_t kBeams = 161;

/// Beams one degree apart, from 80 degrees on the right to 80 on the left (or vice versa), none of
/// which hits anything.
LabeledScan emptyScan(bool from_the_left = false) {
  LabeledScan scan;
  scan.scanner_in_base = Pose2(2.0, 0.0, 0.0);
  scan.field = {-degrees(80.0), degrees(1.0), kBeams, 0.5, 60.0, 80.0, 0.0};
  if (from_the_left) {
    scan.field.first_bearing *= -1.0;
    scan.field.beam_spacing *= -1.0;
  }
  return scan;
}

/// All beams from one bearing to another one (rad) end at this x (m, base frame).
void addWall(LabeledScan& scan, double x, PointState state, double from = -1.0, double to = 1.0) {
  for (std::uint32_t beam = 0; beam < kBeams; ++beam) {
    const double bearing = scan.field.first_bearing + beam * scan.field.beam_spacing;
    if (bearing >= from && bearing <= to) {
      const double range = (x - scan.scanner_in_base.x()) / std::cos(bearing);
      const Point2 end(x, range * std::sin(bearing));
      scan.points.push_back({end, range, bearing, beam, state});
    }
  }
}

/// A car's rear 20 m ahead of the scanner, whose range is known to `sigma` (m).
Object car(double sigma) {
  Object object = boxObject(22.5, 0.0, 1.0, 1.8, 0.0, "stereo");
  object.position_covariance << sigma * sigma, 0.0, 0.0, 0.01;
  return object;
}

PositionEvidence evidence(const LabeledScan& scan, const Object& object, double motion_std = 0.0) {
  return ScanSupport(scan, ScanSupportOptions()).evidence(object, motion_std);
}

TEST(ScanSupportTest, BeamsThatEndThereOnStaticPointsShowThatItIsStationary) {
  for (const bool from_the_left : {false, true}) {
    LabeledScan scan = emptyScan(from_the_left);
    addWall(scan, 22.5, PointState::kStatic);
    const ScanSupport scan_support(scan, ScanSupportOptions());
    const PositionEvidence said = scan_support.evidence(car(1.0), 0.0);
    EXPECT_EQ(said.static_share, 1.0);
    EXPECT_EQ(said.through_share, 0.0);
    EXPECT_NEAR(said.beams, toDegrees(2.0 * std::atan2(0.9, 20.0)), 1e-6);
    EXPECT_TRUE(scan_support.standsStill(said));
  }
}

TEST(ScanSupportTest, BeamsThatEndThereOnOtherPointsAreUninformative) {
  for (const PointState state : {PointState::kMoving, PointState::kUnknown}) {
    LabeledScan scan = emptyScan();
    addWall(scan, 22.0, state);
    const PositionEvidence said = evidence(scan, car(1.0));
    EXPECT_EQ(said.static_share, 0.0);
    EXPECT_EQ(said.through_share, 0.0);
  }
}

TEST(ScanSupportTest, BeamsThatEndFarBehindPassedThrough) {
  LabeledScan scan = emptyScan();
  addWall(scan, 30.0, PointState::kStatic);
  EXPECT_EQ(evidence(scan, car(1.0)).through_share, 1.0);
  EXPECT_EQ(evidence(scan, car(1.0)).static_share, 0.0);
  // Its far side may be there, or may have been there a moment ago.
  EXPECT_EQ(evidence(scan, car(4.0)).through_share, 0.0);
  EXPECT_EQ(evidence(scan, car(1.0), 4.0).through_share, 0.0);
}

TEST(ScanSupportTest, HiddenObjectsAreNotJudged) {
  LabeledScan scan = emptyScan();
  addWall(scan, 12.0, PointState::kStatic);
  const PositionEvidence said = evidence(scan, car(1.0));
  EXPECT_EQ(said.static_share, 0.0);
  EXPECT_EQ(said.through_share, 0.0);
}

TEST(ScanSupportTest, ACarHiddenFromTheScannerInFrontOfAWallIsNotStationary) {
  // A van hides all of it except the right edge, beside which the wall is visible.
  LabeledScan scan = emptyScan();
  addWall(scan, 23.5, PointState::kStatic, -1.0, -degrees(1.5));
  addWall(scan, 10.0, PointState::kMoving, -degrees(1.5), 1.0);
  const ScanSupport scan_support(scan, ScanSupportOptions());
  EXPECT_FALSE(scan_support.standsStill(scan_support.evidence(car(2.0), 0.0)));
}

TEST(ScanSupportTest, AParkedRowBehindDoesNotFreezePassingObjects) {
  LabeledScan scan = emptyScan();
  addWall(scan, 25.0, PointState::kStatic);
  const ScanSupport scan_support(scan, ScanSupportOptions());
  EXPECT_FALSE(scan_support.standsStill(scan_support.evidence(car(1.0), 0.0)));
}

TEST(ScanSupportTest, BeamsWithoutReturnPassThroughAsFarAsTheyAreKnownFree) {
  LabeledScan scan = emptyScan();
  EXPECT_EQ(evidence(scan, car(1.0)).through_share, 1.0);
  scan.field.free_range = 15.0;
  EXPECT_EQ(evidence(scan, car(1.0)).through_share, 0.0);
  scan.field.free_range = 0.0;
  EXPECT_EQ(evidence(scan, car(1.0)).through_share, 0.0);
}

TEST(ScanSupportTest, BlindBeamsAreUninformative) {
  LabeledScan scan = emptyScan();
  for (std::uint32_t beam = 0; beam < kBeams; ++beam) {
    scan.blind_beams.push_back(beam);
  }
  EXPECT_EQ(evidence(scan, car(1.0)).through_share, 0.0);
}

TEST(ScanSupportTest, OutsideTheFieldItIsUnknown) {
  const LabeledScan scan = emptyScan();
  Object behind = car(1.0);
  behind.box.center = Pose2(-20.0, 0.0, 0.0);
  const PositionEvidence said = evidence(scan, behind);
  EXPECT_EQ(said.static_share, 0.0);
  EXPECT_EQ(said.through_share, 0.0);
  // Half of it is: the rest is not assumed to be free.
  Object at_edge = car(1.0);
  at_edge.box.center = Pose2(
      scan.scanner_in_base * (20.0 * Point2(std::cos(degrees(80.0)), std::sin(degrees(80.0)))),
      degrees(80.0));
  const double share = evidence(scan, at_edge).through_share;
  EXPECT_GT(share, 0.3);
  EXPECT_LT(share, 0.7);
}

TEST(ScanSupportTest, AThinPoleIsJudgedByTheNearestBeam) {
  LabeledScan scan = emptyScan();
  Object pole = pointObject(0.0, 0.0, 0.1, "stereo");
  pole.box = {Pose2(scan.scanner_in_base *
                        (20.0 * Point2(std::cos(degrees(10.4)), std::sin(degrees(10.4)))),
                    0.0),
              0.1, 0.1};
  const PositionEvidence said = evidence(scan, pole);
  EXPECT_EQ(said.through_share, 1.0);
  EXPECT_LT(said.beams, 0.5);
}

TEST(ScanSupportTest, NoBeamIsMissedAtTheSeamOfAFullTurn) {
  // 514.3 beams are a turn: the last one and the first are closer together than others.
  LabeledScan scan = emptyScan();
  scan.field.beam_spacing = degrees(0.7);
  scan.field.first_bearing = -kPi;
  scan.field.beams = 514;
  for (std::uint32_t beam = 0; beam < scan.field.beams; ++beam) {
    const double bearing = scan.field.first_bearing + beam * scan.field.beam_spacing;
    const Point2 end = scan.scanner_in_base * (20.0 * Point2(std::cos(bearing), std::sin(bearing)));
    scan.points.push_back({end, 20.0, bearing, beam, PointState::kStatic});
  }
  Object behind = car(1.0);
  behind.box.center = Pose2(-18.5, 0.0, 0.0);
  EXPECT_EQ(evidence(scan, behind).static_share, 1.0);
}

TEST(ScanSupportTest, BeamsFinerThanThoseOfAnyScannerAreUninformative) {
  LabeledScan scan = emptyScan();
  scan.field.beam_spacing = 1e-9;
  EXPECT_EQ(evidence(scan, car(1.0)).beams, 0.0);
}

TEST(ScanSupportTest, WithoutAFieldOrAroundTheScannerItIsUnknown) {
  LabeledScan scan = emptyScan();
  Object around = boxObject(2.0, 0.0, 2.0, 2.0, 0.01, "stereo");
  EXPECT_EQ(evidence(scan, around).through_share, 0.0);
  scan.field = ScanField();
  EXPECT_EQ(evidence(scan, car(1.0)).through_share, 0.0);
}

}  // namespace
}  // namespace datmo::scan_support_test
