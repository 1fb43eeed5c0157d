// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/motion_likelihood.h"

#include <cmath>
#include <vector>

#include "scan_history_samples.h"
#include <gtest/gtest.h>

namespace datmo::motion_likelihood_test {
namespace {

using samples::scanOf;

/// An object whose points are given, in the fixed frame.
Object objectOf(const std::vector<Point2>& points) {
  Object object;
  object.points = points;
  return object;
}

class BeamEvidenceTest : public testing::Test {
 protected:
  /// What is computed by hand below goes by these, not by the defaults.
  BeamEvidenceTest() {
    options_.detection = 0.8;
    options_.detection_strength = 10.0;
    options_.echo_detection = 0.6;
    options_.background = 0.1;
  }

  /// A scan `seconds` after the start, with ends of beams at these positions.
  void scan(double seconds, const std::vector<Point2>& ends) {
    history_.add(scanOf(ends, seconds));
  }

  void see(double seconds, const std::vector<Point2>& points) {
    seen_.add(objectOf(points), seconds, options_.window);
  }

  BeamEvidence evidence(double seconds, const MovingBody& body) const {
    return beamEvidence(history_, seen_, body, Stamp::fromSeconds(100.0 + seconds), seconds,
                        options_);
  }

  /// A body that never covered (20, 0), for certain.
  static MovingBody elsewhere() { return {{Pose2(40.0, 20.0, 0.0), 4.0, 2.0}}; }

  MotionLikelihoodOptions options_;
  ScanHistory history_{ScanHistoryOptions{}};
  SeenPointHistory seen_;
};

TEST_F(BeamEvidenceTest, WithoutScansNothingIsKnown) {
  see(0.0, {{20.0, 0.0}});
  const BeamEvidence nothing = evidence(0.0, elsewhere());
  EXPECT_EQ(nothing.observed, 0U);
  EXPECT_EQ(nothing.log_ratio, 0.0);
}

TEST_F(BeamEvidenceTest, TheScanInWhichItWasSeenSaysNothing) {
  scan(0.0, {{20.0, 0.0}});
  see(0.0, {{20.0, 0.0}});
  EXPECT_EQ(evidence(0.0, elsewhere()).observed, 0U);
}

TEST_F(BeamEvidenceTest, PositionsWhereNoBeamOfTheirScanEndedAreNotAsked) {
  scan(0.0, {});
  scan(0.1, {{20.0, 0.0}});
  see(0.1, {{20.0, 1.0}});  // as a camera has it
  const BeamEvidence of_camera = evidence(0.1, elsewhere());
  EXPECT_EQ(of_camera.observed, 0U);
  EXPECT_TRUE(of_camera.by_others);
  see(0.1, {{20.0, 0.0}, {20.0, 1.0}});
  const BeamEvidence of_both = evidence(0.1, elsewhere());
  EXPECT_EQ(of_both.observed, 1U);
  EXPECT_FALSE(of_both.by_others);
}

TEST_F(BeamEvidenceTest, ABeamThatPassedBeforeSpeaksForMotion) {
  scan(0.0, {});
  scan(0.1, {{20.0, 0.0}});
  see(0.1, {{20.0, 0.0}});
  const BeamEvidence entered = evidence(0.1, elsewhere());
  EXPECT_EQ(entered.observed, 1U);
  EXPECT_NEAR(entered.log_ratio, std::log(0.9 / 0.4), 1e-9) << "of a single echo";
}

TEST_F(BeamEvidenceTest, ABeamThatPassesAfterwardSpeaksForMotionToo) {
  scan(0.0, {{20.0, 0.0}});
  see(0.0, {{20.0, 0.0}});
  scan(0.1, {});
  EXPECT_NEAR(evidence(0.1, elsewhere()).log_ratio, std::log(0.9 / 0.4), 1e-9);
}

TEST_F(BeamEvidenceTest, ABeamThatEndedThereBeforeSpeaksAgainstMotion) {
  scan(0.0, {{20.0, 0.0}});
  scan(0.1, {{20.0, 0.0}});
  see(0.1, {{20.0, 0.0}});
  EXPECT_NEAR(evidence(0.1, elsewhere()).log_ratio, std::log(0.1 / 0.6), 1e-9);
}

TEST_F(BeamEvidenceTest, SurfacesCountForMoreThanEchoes) {
  const std::vector<Point2> side{{20.0, -0.7}, {20.0, 0.0}, {20.0, 0.7}};
  scan(0.0, {});
  scan(0.1, side);
  see(0.1, side);
  const BeamEvidence entered = evidence(0.1, elsewhere());
  EXPECT_EQ(entered.observed, 3U);
  // Three misses of a surface of which 8 beams hit and 2 missed: 2/10, 3/11, 4/12.
  EXPECT_NEAR(entered.log_ratio, 3.0 * std::log(0.9) - std::log(24.0 / 1320.0), 1e-9);
}

TEST_F(BeamEvidenceTest, WhatIsHitNowAndThenMayStand) {
  const std::vector<Point2> edge{{20.0, 0.0}};
  scan(0.0, {});
  scan(0.1, edge);
  scan(0.2, {});
  scan(0.3, edge);
  see(0.3, edge);
  // An echo's 6 hits and 4 misses: a miss 4/10, a hit 6/11, a miss 5/12.
  const double stands = 4.0 / 10.0 * 6.0 / 11.0 * 5.0 / 12.0;
  EXPECT_NEAR(evidence(0.3, elsewhere()).log_ratio, std::log(0.9 * 0.1 * 0.9 / stands), 1e-9);
}

TEST_F(BeamEvidenceTest, WhatIsNeverHitBeforehandIsSoonNoEdge) {
  const std::vector<Point2> side{{20.0, -0.7}, {20.0, 0.0}, {20.0, 0.7}};
  for (int i = 0; i < 5; ++i) {
    scan(0.1 * i, {});
  }
  scan(0.5, side);
  see(0.5, side);
  EXPECT_GT(evidence(0.5, elsewhere()).log_ratio, std::log(1e3));
}

TEST_F(BeamEvidenceTest, WhereTheBodyCoversItsPositionBothSayTheSame) {
  scan(0.0, {{20.0, 0.0}});
  scan(0.1, {{20.0, 0.0}});
  see(0.1, {{20.0, 0.0}});
  const MovingBody large{{Pose2(20.0, 0.0, 0.0), 100.0, 100.0}, {0.0, 0.0}, {5.0, 0.0}};
  EXPECT_NEAR(evidence(0.1, large).log_ratio, 0.0, 1e-6);
}

TEST_F(BeamEvidenceTest, WhatIsHiddenSaysNothing) {
  scan(0.0, {{10.0, 0.0}});
  scan(0.1, {{20.0, 0.0}});
  see(0.1, {{20.0, 0.0}});
  EXPECT_EQ(evidence(0.1, elsewhere()).observed, 0U);
}

TEST_F(BeamEvidenceTest, PositionsThatOneScanCrossesCountInTheirMean) {
  scan(0.0, {});
  scan(0.1, {{20.0, 0.0}, {20.0, 5.0}});
  see(0.1, {{20.0, 0.0}});
  see(0.1, {{20.0, 5.0}});
  const BeamEvidence entered = evidence(0.1, elsewhere());
  EXPECT_EQ(entered.observed, 2U);
  EXPECT_NEAR(entered.log_ratio, std::log(0.9 / 0.4), 1e-9);
}

TEST_F(BeamEvidenceTest, BeamsBeforeTheWindowAreNotAsked) {
  scan(0.0, {});
  scan(2.5, {{20.0, 0.0}});
  see(2.5, {{20.0, 0.0}});
  EXPECT_EQ(evidence(2.5, elsewhere()).observed, 0U);
}

/// The end of a beam that moves along a wall with the scanner, along x, as the scanner passes it.
class GrazingTest : public BeamEvidenceTest {
 protected:
  /// Scans of an echo at these positions relative to the scanner, 0.1 s apart.
  double grazingShare(const std::vector<Point2>& positions, double speed = 8.0) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double seconds = 0.1 * static_cast<double>(i);
      const double x = speed * seconds;  // of the scanner
      const Point2 position = positions[i] + Point2(x, 0.0);
      history_.add(scanOf({position}, seconds, Pose2(x, 0.0, 0.0)));
      see(seconds, {position});
    }
    const double end = 0.1 * static_cast<double>(positions.size() - 1);
    return evidence(end, {{Pose2(positions.back() + Point2(speed * end, 0.0), 0.0), 0.5, 0.5},
                          {0.0, 0.0},
                          {speed, 0.0},
                          0.04})
        .grazing_share;
  }
  double grazingShareAt(const Point2& position) {
    return grazingShare({position, position, position});
  }
};

TEST_F(GrazingTest, AnEchoBesideThePathThatKeepsItsBeamMayBeTheEndOfOneAlongAWall) {
  EXPECT_NEAR(grazingShareAt({20.0, 5.0}), options_.grazing_share, 1e-9);
}

TEST_F(GrazingTest, NoWallStandsInTheVehiclesOwnPath) {
  EXPECT_LT(grazingShareAt({20.0, 0.5}), 0.01 * options_.grazing_share);
}

TEST_F(GrazingTest, AtTheEdgeOfThePathAWallIsHalfAsLikely) {
  options_.free_path = 1.4;  // m: a beam looks there
  EXPECT_NEAR(grazingShareAt({20.0, 1.4}), 0.5 * options_.grazing_share, 1e-9);
}

TEST_F(GrazingTest, FarAheadThePathIsLessCertain) {
  const double near = grazingShareAt({20.0, 1.4});
  history_.clear();
  seen_.clear();
  EXPECT_GT(grazingShareAt({40.0, 1.4}), 1.5 * near);
}

TEST_F(GrazingTest, AtACreepNobodyKnowsWhereThePathLeads) {
  const std::vector<Point2> ahead(5, {20.0, 0.0});
  EXPECT_GT(grazingShare(ahead, 0.05), 0.4 * options_.grazing_share);
}

TEST_F(GrazingTest, InABendAWallMayStandStraightAhead) {
  // 8 m/s on a radius of 50 m to the left, whose outer wall is met by the beam straight ahead.
  constexpr double kRadius = 50.0;
  constexpr double kYawRate = 8.0 / kRadius;
  Pose2 scanner;
  for (int i = 0; i <= 15; ++i) {
    const double seconds = 0.1 * i;
    const double turn = kYawRate * seconds;
    scanner = Pose2(kRadius * std::sin(turn), kRadius * (1.0 - std::cos(turn)), turn);
    const Point2 position = scanner * Point2(20.0, 0.0);
    history_.add(scanOf({position}, seconds, scanner));
    see(seconds, {position});
  }
  const Point2 along = scanner.rotate(Point2(8.0, 0.0));
  const MovingBody end_of_beam{
      {scanner * Pose2(20.0, 0.0, 0.0), 0.5, 0.5}, {0.0, 0.0}, along, 0.04};
  EXPECT_GT(evidence(1.5, end_of_beam).grazing_share, 0.2 * options_.grazing_share);
}

TEST_F(GrazingTest, WhatNoBeamEndedAtIsNone) {
  see(0.0, {{20.0, 5.0}});
  for (const double seconds : {0.0, 0.1}) {
    history_.add(scanOf({}, seconds, Pose2(seconds, 0.0, 0.0)));
  }
  const MovingBody keeps_its_bearing{
      {Pose2(20.1, 5.0, 0.0), 0.5, 0.5}, {0.0, 0.0}, {1.0, 0.0}, 0.04};
  EXPECT_EQ(evidence(0.1, keeps_its_bearing).grazing_share, 0.0);
}

TEST_F(GrazingTest, AnEchoThatGoesFromBeamToBeamIsNone) {
  EXPECT_EQ(grazingShare({{20.0, 5.0}, {20.0, 5.7}, {20.0, 5.7}}), 0.0);
}

const std::vector<double> kSpeeds = {2.0};  // m/s
constexpr double kApparent = 0.1;

double velocityRatio(double speed, double sigma) {
  return velocityLogRatio({speed, 0.0}, sigma * sigma * Eigen::Matrix2d::Identity(), kSpeeds,
                          kApparent);
}

TEST(VelocityLogRatio, IsThatOfTheTwoDensities) {
  // Along x N(1; 0, 1 + 4) over N(1; 0, 1), along y N(0; 0, 5) over N(0; 0, 1).
  const double bayes_factor = 0.2 * std::exp(0.5 * (1.0 - 0.2));
  EXPECT_NEAR(velocityRatio(1.0, 1.0),
              std::log(bayes_factor / (1.0 - kApparent + kApparent * bayes_factor)), 1e-12);
}

TEST(VelocityLogRatio, RestSpeaksAgainstMotionTheMoreTheSurerItIs) {
  EXPECT_LT(velocityRatio(0.0, 1.0), 0.0);
  EXPECT_LT(velocityRatio(0.0, 0.2), velocityRatio(0.0, 1.0));
  EXPECT_NEAR(velocityRatio(0.0, 1e3), 0.0, 1e-5) << "nothing is known";
}

TEST(VelocityLogRatio, NoVelocityOutweighsWhatOnlySeemsToMove) {
  EXPECT_NEAR(velocityRatio(3.0, 0.1), std::log(1.0 / kApparent), 1e-3);
}

TEST(VelocityLogRatio, SpeedsOfSeveralKindsAreAMixture) {
  const Eigen::Matrix2d covariance = 0.25 * Eigen::Matrix2d::Identity();
  const auto ratio = [&](const std::vector<double>& speeds) {
    return velocityLogRatio({1.4, 0.0}, covariance, speeds, kApparent);
  };
  EXPECT_GT(ratio({1.25}), ratio({1.25, 8.0}));
  EXPECT_GT(ratio({1.25, 8.0}), ratio({8.0}));
}

/// `share`: of echoes at the end of a beam along a wall.
BeamEvidence evidence(double facing, double grazing, double share) {
  return {facing, grazing, share, 1};
}

TEST(MotionLogRatio, AddsTheVelocityWhereNothingGrazes) {
  EXPECT_DOUBLE_EQ(motionLogRatio(evidence(1.5, 0.0, 0.0), 0.5), 2.0);
}

TEST(MotionLogRatio, TheEndOfABeamAlongAWallMovesToo) {
  // However fast it is, what the beams do not refute is as likely as its share.
  EXPECT_NEAR(motionLogRatio(evidence(50.0, 0.0, 0.1), 2.0), std::log(10.0), 1e-9);
  EXPECT_NEAR(motionLogRatio(evidence(50.0, 3.0, 0.1), 2.0), std::log(10.0) + 3.0, 1e-9);
}

TEST(MotionLogRatio, WhatFacesTheBeamsCountsByItsShare) {
  EXPECT_NEAR(motionLogRatio(evidence(-2.0, 50.0, 0.1), 1.0), -1.0 - std::log(0.9), 1e-9);
}

TEST(MotionProbability, IsThatOfNeitherOfTheTwoOthers) {
  const MotionLikelihoodOptions options;  // half of the candidates move
  const auto probability = [&](double against_standing, double existence) {
    return motionProbability(against_standing, existence, options);
  };
  EXPECT_NEAR(probability(std::log(19.0), 1e3), 0.95, 1e-9);
  EXPECT_NEAR(probability(1e3, std::log(19.0)), 0.95, 1e-9);
  EXPECT_NEAR(probability(0.0, 0.0), 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(probability(-1e3, 1e3), 0.0, 1e-9);
}

}  // namespace
}  // namespace datmo::motion_likelihood_test
