// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/visibility/scan_history.h"

#include <limits>

#include "scan_history_samples.h"
#include <gtest/gtest.h>

namespace datmo::scan_history_test {
namespace {

using samples::scanOf;

class ScanHistoryTest : public testing::Test {
 protected:
  /// At an object that extends across the x axis.
  BeamOutcome lookAt(const Point2& position) const {
    return history_.look(0, {position, Point2::UnitY()}).outcome;
  }

  ScanHistory history_{ScanHistoryOptions{}};
};

TEST_F(ScanHistoryTest, SeesAHitNearItsEnd) {
  history_.add(scanOf({{20.0, 0.0}}, 0.0));
  EXPECT_EQ(lookAt({20.0, 0.0}), BeamOutcome::kHit);
  EXPECT_EQ(lookAt({20.3, 0.0}), BeamOutcome::kHit)
      << "the tolerance is 0.4 m, and 0.1 m for the bearing";
  EXPECT_EQ(lookAt({20.6, 0.0}), BeamOutcome::kNothing);
}

TEST_F(ScanHistoryTest, AGrazingBeamMeetsACurbSomeDistanceAlong) {
  // A curb along y = 2; the beam at 6 degrees hits it at 19.03 m ahead.
  const Point2 met(2.0 / std::tan(kPi / 30.0), 2.0);
  history_.add(scanOf({met}, 0.0));
  const Point2 beside(19.6, 2.0);  // the same beam hits it
  EXPECT_EQ(history_.look(0, {beside, Point2::UnitX()}).outcome, BeamOutcome::kHit);
  EXPECT_EQ(history_.look(0, {beside, Point2::UnitY()}).outcome, BeamOutcome::kNothing)
      << "behind the hit";
}

TEST_F(ScanHistoryTest, ThePointBesideTheCurbIsFreeIfTheCurbIsSeen) {
  const Point2 met(2.0 / std::tan(kPi / 30.0), 2.0);
  history_.add(scanOf({met}, 0.0));
  EXPECT_EQ(history_.look(0, {{19.0, 1.8}, Point2::UnitX()}).outcome, BeamOutcome::kNothing)
      << "no beam lights it";
  const Point2 in_beam(1.8 / std::tan(kPi / 30.0), 1.8);
  EXPECT_EQ(history_.look(0, {in_beam, Point2::UnitX()}).outcome, BeamOutcome::kFree);
}

TEST_F(ScanHistoryTest, AFlatBeamMayMissTheLineByMore) {
  // 0.005 rad at 19.1 m and 6 degrees to the line are 0.91 m along the beam.
  const double bearing = kPi / 30.0;
  const double crossing = 2.0 / std::sin(bearing);
  const ReflectionPoint position{{crossing * std::cos(bearing), 2.0}, Point2::UnitX()};
  const auto endsAt = [&](double range, double seconds) {
    history_.add(scanOf({{range * std::cos(bearing), range * std::sin(bearing)}}, seconds));
    return history_.look(0, position).outcome;
  };
  EXPECT_EQ(endsAt(crossing + 1.2, 0.0), BeamOutcome::kHit);
  EXPECT_EQ(endsAt(crossing + 1.5, 1.0), BeamOutcome::kFree);
  EXPECT_EQ(endsAt(crossing - 1.5, 2.0), BeamOutcome::kNothing);
}

TEST_F(ScanHistoryTest, ABeamAlongALineIsNoEvidenceOfIt) {
  history_.add(scanOf({{20.0, 0.0}}, 0.0));
  EXPECT_EQ(history_.look(0, {{20.0, 0.0}, Point2::UnitX()}).outcome, BeamOutcome::kNothing);
}

TEST(ScanHistorySparseTest, ABeamThatDivergesFromTheLineIsNoEvidenceOfIt) {
  // Beams half a radian apart: the one straight ahead hits a point 0.2 rad beside it, but meets the
  // line there only behind the scanner, at -3.4 m.
  ScanHistoryOptions options;
  options.lit_share = 1.0;
  ScanHistory history(options);
  LabeledScan scan = scanOf({}, 0.0);
  scan.field.beams = 3;
  scan.field.beam_spacing = 0.5;
  scan.field.first_bearing = -0.5;
  history.add(scan);
  const Point2 position(10.0 * std::cos(0.2), 10.0 * std::sin(0.2));
  EXPECT_EQ(history.look(0, {position, {std::cos(0.15), std::sin(0.15)}}).outcome,
            BeamOutcome::kNothing);
  EXPECT_EQ(history.look(0, {position, Point2::UnitY()}).outcome, BeamOutcome::kFree);
}

TEST_F(ScanHistoryTest, CellsThatABeamPassedAreFree) {
  history_.add(scanOf({{20.0, 0.0}}, 0.0));
  EXPECT_EQ(lookAt({10.0, 0.0}), BeamOutcome::kFree);
  EXPECT_EQ(lookAt({19.0, 0.0}), BeamOutcome::kFree);
}

TEST_F(ScanHistoryTest, SeesNothingBehindAHit) {
  history_.add(scanOf({{20.0, 0.0}}, 0.0));
  EXPECT_EQ(lookAt({21.0, 0.0}), BeamOutcome::kNothing);
}

TEST_F(ScanHistoryTest, ABeamWithoutReturnIsFreeUpToTheFreeRange) {
  history_.add(scanOf({}, 0.0));
  EXPECT_EQ(lookAt({39.3, 0.0}), BeamOutcome::kFree);
  EXPECT_EQ(lookAt({39.7, 0.0}), BeamOutcome::kNothing);
}

TEST_F(ScanHistoryTest, SeesNothingBetweenTheBeams) {
  history_.add(scanOf({}, 0.0));
  const double halfway = kPi / 180.0;
  EXPECT_EQ(lookAt({30.0 * std::cos(halfway), 30.0 * std::sin(halfway)}), BeamOutcome::kNothing);
}

TEST_F(ScanHistoryTest, SeesNothingOutsideOfTheField) {
  history_.add(scanOf({}, 0.0));
  EXPECT_EQ(lookAt({-10.0, 0.0}), BeamOutcome::kNothing);
  EXPECT_EQ(lookAt({0.5, 10.0}), BeamOutcome::kNothing) << "the field ends at 80 degrees";
}

TEST_F(ScanHistoryTest, SeesNothingAtNonFinitePositions) {
  history_.add(scanOf({}, 0.0));
  EXPECT_EQ(lookAt({std::numeric_limits<double>::quiet_NaN(), 0.0}), BeamOutcome::kNothing);
  EXPECT_EQ(lookAt({std::numeric_limits<double>::infinity(), 0.0}), BeamOutcome::kNothing);
}

TEST_F(ScanHistoryTest, ABlindBeamIsUninformative) {
  LabeledScan scan = scanOf({}, 0.0);
  scan.blind_beams = {40};
  history_.add(scan);
  EXPECT_EQ(lookAt({10.0, 0.0}), BeamOutcome::kNothing);
}

TEST_F(ScanHistoryTest, PointsAreInTheMapFrame) {
  history_.add(scanOf({{20.0, 5.0}}, 0.0, Pose2(10.0, 5.0, 0.0)));
  EXPECT_EQ(lookAt({20.0, 5.0}), BeamOutcome::kHit);
  EXPECT_EQ(lookAt({15.0, 5.0}), BeamOutcome::kFree);
  EXPECT_EQ(lookAt({5.0, 5.0}), BeamOutcome::kNothing) << "behind the vehicle";
}

TEST_F(ScanHistoryTest, AFullTurnIsSeenAllRound) {
  LabeledScan scan = scanOf({}, 0.0);
  scan.field.beams = 180;
  scan.field.first_bearing = -kPi;
  history_.add(scan);
  EXPECT_EQ(lookAt({10.0, 0.0}), BeamOutcome::kFree);
  EXPECT_EQ(lookAt({-10.0, 0.0}), BeamOutcome::kFree);
  EXPECT_EQ(history_.look(0, {{0.0, 10.0}, Point2::UnitX()}).outcome, BeamOutcome::kFree);
  EXPECT_EQ(history_.look(0, {{0.0, -10.0}, Point2::UnitX()}).outcome, BeamOutcome::kFree);
}

TEST_F(ScanHistoryTest, AScanOfAnUnknownFieldIsUninformative) {
  LabeledScan scan = scanOf({{20.0, 0.0}}, 0.0);
  scan.field = {};
  history_.add(scan);
  EXPECT_EQ(lookAt({20.0, 0.0}), BeamOutcome::kNothing);
  EXPECT_EQ(lookAt({10.0, 0.0}), BeamOutcome::kNothing);
}

TEST_F(ScanHistoryTest, ForgetsOldScans) {
  for (int i = 0; i <= 50; ++i) {
    history_.add(scanOf({}, 0.1 * i));
  }
  EXPECT_EQ(history_.size(), 41U) << "4 s";
  EXPECT_NEAR(history_.age(10), 1.0, 1e-9);
  history_.clear();
  EXPECT_EQ(history_.size(), 0U);
}

TEST(ScanHistoryMemoryTest, HoldsALimitedNumberOfScans) {
  ScanHistoryOptions options;
  options.max_scans = 5;
  ScanHistory history(options);
  for (int i = 0; i < 20; ++i) {
    history.add(scanOf({}, 0.01 * i));
  }
  EXPECT_EQ(history.size(), 5U);
}

}  // namespace
}  // namespace datmo::scan_history_test
