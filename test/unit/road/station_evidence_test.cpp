// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/station_evidence.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace datmo::station_evidence_test {
namespace {

class StationEvidenceTest : public testing::Test {
 protected:
  StationEvidenceTest() { evidence_.keepWithin({0.0, 30.0}); }

  void hit(double first, double last, int scans = 5) {
    for (int scan = 0; scan < scans; ++scan) {
      for (double along = first + 0.5; along < last; along += 1.0) {
        evidence_.addHit(along);
      }
      evidence_.endScan();
    }
  }

  StationEvidenceOptions options_;
  StationEvidence evidence_{options_};
};

TEST_F(StationEvidenceTest, IsUnknownInitially) {
  EXPECT_EQ(evidence_.logOdds(5.0), 0.0);
  EXPECT_TRUE(evidence_.pieces().empty());
}

TEST_F(StationEvidenceTest, OnePassageByHand) {
  evidence_.addPassage(5.5);
  EXPECT_EQ(evidence_.logOdds(5.5), 0.0) << "told at the end of the scan";
  evidence_.endScan();
  EXPECT_NEAR(evidence_.logOdds(5.5),
              std::log((1.0 - options_.hit_probability) / (1.0 - options_.clutter)), 1e-12);
  EXPECT_EQ(evidence_.logOdds(6.5), 0.0);
}

TEST_F(StationEvidenceTest, ManyBeamsOfAScanCountAsOneAndAllScansAreHeld) {
  for (int i = 0; i < 100; ++i) {
    evidence_.addHit(5.5);
  }
  evidence_.endScan();
  EXPECT_EQ(evidence_.logOdds(5.5), options_.max_per_scan);
  hit(5.0, 6.0, 100);
  EXPECT_EQ(evidence_.logOdds(5.5), options_.saturation);
}

TEST_F(StationEvidenceTest, ShortGapsAreBridgedLongOnesEndAPiece) {
  hit(2.0, 6.0);
  hit(6.0 + options_.bridged_gap - 1.0, 15.0);
  ASSERT_EQ(evidence_.pieces().size(), 1U);
  EXPECT_NEAR(evidence_.pieces()[0].first, 2.0, 1e-12);
  EXPECT_NEAR(evidence_.pieces()[0].last, 15.0, 1e-12);
  hit(15.0 + options_.bridged_gap, 30.0);
  EXPECT_EQ(evidence_.pieces().size(), 2U);
}

TEST_F(StationEvidenceTest, PassagesRemoveABorderAgain) {
  hit(2.0, 3.0);
  ASSERT_EQ(evidence_.seenStations(), 1);
  for (int scan = 0; scan < 200; ++scan) {
    evidence_.addPassage(2.5);
    evidence_.endScan();
  }
  EXPECT_EQ(evidence_.seenStations(), 0);
}

TEST_F(StationEvidenceTest, IsForgottenOutsideTheKeptRange) {
  hit(2.0, 20.0);
  evidence_.keepWithin({10.0, 40.0});
  EXPECT_EQ(evidence_.logOdds(5.0), 0.0);
  EXPECT_GT(evidence_.logOdds(15.0), 0.0);
  evidence_.keepWithin({0.0, 40.0});
  EXPECT_EQ(evidence_.logOdds(5.0), 0.0);
  EXPECT_GT(evidence_.logOdds(15.0), 0.0);
  evidence_.keepWithin({500.0, 540.0});
  EXPECT_TRUE(evidence_.pieces().empty());
}

TEST_F(StationEvidenceTest, DepthShowsThatTheRoadIsOpen) {
  evidence_.addDepth(5.5, true);
  evidence_.addDepth(7.5, false);
  evidence_.endScan();
  EXPECT_GT(evidence_.openLogOdds(5.5), 0.0);
  EXPECT_LT(evidence_.openLogOdds(7.5), 0.0);
  EXPECT_EQ(evidence_.openLogOdds(9.5), 0.0);
}

TEST(StationEvidenceLimitsTest, PointsAtInfinityAreHarmless) {
  StationEvidence evidence{StationEvidenceOptions{}};
  for (const double far : {1e300, -1e300, std::numeric_limits<double>::quiet_NaN()}) {
    evidence.keepWithin({far, far + 65.0});
    evidence.addHit(far);
    evidence.addPassage(far);
    evidence.endScan();
    EXPECT_LE(evidence.pieces().size(), 1U);
  }
}

}  // namespace
}  // namespace datmo::station_evidence_test
