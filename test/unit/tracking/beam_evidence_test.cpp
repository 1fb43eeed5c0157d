// SPDX-License-Identifier: BSD-3-Clause
// Beams as evidence of an object's motion: where they ended, and what they passed.
#include "beam_evidence_scene.h"

namespace datmo::beam_evidence_test {
namespace {

using BeamEvidenceTest = samples::BeamEvidenceScene;

TEST_F(BeamEvidenceTest, WithoutScansThereIsNoEvidence) {
  see(0.0, {{20.0, 0.0}});
  const BeamEvidence nothing = evidence(0.0, elsewhere());
  EXPECT_EQ(nothing.observed, 0U);
  EXPECT_EQ(nothing.log_ratio, 0.0);
}

TEST_F(BeamEvidenceTest, TheScanInWhichItWasSeenIsNoEvidence) {
  scan(0.0, {{20.0, 0.0}});
  see(0.0, {{20.0, 0.0}});
  EXPECT_EQ(evidence(0.0, elsewhere()).observed, 0U);
}

TEST_F(BeamEvidenceTest, PositionsWithoutBeamEndsAreNotEvaluated) {
  scan(0.0, {});
  scan(0.1, {{20.0, 0.0}});
  see(0.1, {{20.0, 1.0}});  // as a camera reports it
  const BeamEvidence of_camera = evidence(0.1, elsewhere());
  EXPECT_EQ(of_camera.observed, 0U);
  EXPECT_TRUE(of_camera.by_others);
  see(0.1, {{20.0, 0.0}, {20.0, 1.0}});
  const BeamEvidence of_both = evidence(0.1, elsewhere());
  EXPECT_EQ(of_both.observed, 1U);
  EXPECT_FALSE(of_both.by_others);
}

TEST_F(BeamEvidenceTest, ABeamThatPassedBeforeIsEvidenceForMotion) {
  scan(0.0, {});
  scan(0.1, {{20.0, 0.0}});
  see(0.1, {{20.0, 0.0}});
  const BeamEvidence entered = evidence(0.1, elsewhere());
  EXPECT_EQ(entered.observed, 1U);
  EXPECT_NEAR(entered.log_ratio, std::log(0.9 / 0.4), 1e-9) << "of a single echo";
}

TEST_F(BeamEvidenceTest, ABeamThatPassesAfterwardIsEvidenceForMotionToo) {
  scan(0.0, {{20.0, 0.0}});
  see(0.0, {{20.0, 0.0}});
  scan(0.1, {});
  EXPECT_NEAR(evidence(0.1, elsewhere()).log_ratio, std::log(0.9 / 0.4), 1e-9);
}

TEST_F(BeamEvidenceTest, ABeamThatEndedThereBeforeIsEvidenceAgainstMotion) {
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

TEST_F(BeamEvidenceTest, AnOccasionallyHitObjectMayBeStationary) {
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

TEST_F(BeamEvidenceTest, AnObjectNeverHitBeforeIsSoonNoEdge) {
  const std::vector<Point2> side{{20.0, -0.7}, {20.0, 0.0}, {20.0, 0.7}};
  for (int i = 0; i < 5; ++i) {
    scan(0.1 * i, {});
  }
  scan(0.5, side);
  see(0.5, side);
  EXPECT_GT(evidence(0.5, elsewhere()).log_ratio, std::log(1e3));
}

TEST_F(BeamEvidenceTest, IfTheBodyCoversItsPositionBothAgree) {
  scan(0.0, {{20.0, 0.0}});
  scan(0.1, {{20.0, 0.0}});
  see(0.1, {{20.0, 0.0}});
  const MovingBody large{{Pose2(20.0, 0.0, 0.0), 100.0, 100.0}, {0.0, 0.0}, {5.0, 0.0}};
  EXPECT_NEAR(evidence(0.1, large).log_ratio, 0.0, 1e-6);
}

TEST_F(BeamEvidenceTest, HiddenPositionsAreNoEvidence) {
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

TEST_F(BeamEvidenceTest, BeamsBeforeTheWindowAreNotEvaluated) {
  scan(0.0, {});
  scan(2.5, {{20.0, 0.0}});
  see(2.5, {{20.0, 0.0}});
  EXPECT_EQ(evidence(2.5, elsewhere()).observed, 0U);
}

}  // namespace
}  // namespace datmo::beam_evidence_test
