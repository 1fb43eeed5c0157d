// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/motion_evidence.h"

#include <cmath>

#include "tracking_scene.h"
#include <gtest/gtest.h>

namespace datmo::motion_evidence_test {
namespace {

/// Well known, so that it never is what decides: 5 m/s, with a variance of 0.01 m^2/s^2.
StateEstimate movingEstimate() {
  StateEstimate estimate;
  estimate.mean[2] = 5.0;
  estimate.covariance *= 0.01;
  return estimate;
}

/// Log-density of a measurement that the motion filter predicted well: it always hits.
constexpr double kWellPredicted = 0.0;

constexpr double kDetection = 0.9;

Object seenAt(double x, double length, std::size_t points = 3) {
  Object object = objectAt(x, 0.0);
  object.box.length = length;
  object.points.assign(points, Point2(x, 0.0));
  return object;
}

PositionMeasurement observedBox(const Object& object) {
  return {object.box.center.position(), object.position_covariance};
}

class MotionEvidenceTest : public testing::Test {
 protected:
  void see(const Object& object, int times = 1) {
    for (int i = 0; i < times; ++i) {
      evidence_.predict(0.1, options_);
      evidence_.update(object, observedBox(object), kWellPredicted, kDetection, options_);
    }
  }
  bool suffices() const { return evidence_.suffices(movingEstimate(), options_); }

  MotionEvidenceOptions options_;
  MotionEvidence evidence_{seenAt(0.0, 1.0), options_};
};

TEST_F(MotionEvidenceTest, AnObjectThatLeavesItsPositionMoves) {
  for (int i = 1; i <= 10; ++i) {
    see(seenAt(0.5 * i, 1.0));
  }
  EXPECT_TRUE(suffices());
}

/// A flank: neither its front nor its rear is seen.
Object flankAt(double x, double length) {
  Object object = seenAt(x, length);
  object.side_variance = {kHiddenSide, kHiddenSide, 0.01, kHiddenSide};
  return object;
}

TEST_F(MotionEvidenceTest, AFlankWithoutEndsDoesNotLeaveItsPositionAlongIt) {
  // What a camera sees of a row of parked cars goes along with it.
  evidence_ = MotionEvidence(flankAt(0.0, 4.0), options_);
  for (int i = 1; i <= 40; ++i) {
    see(flankAt(0.5 * i, 4.0));
    ASSERT_FALSE(suffices()) << i;
  }
}

TEST_F(MotionEvidenceTest, APersonWithoutEndsLeavesItsPosition) {
  const auto personAt = [](double x) {
    Object object = flankAt(x, 0.5);
    object.object_class = ObjectClass::kPedestrian;
    return object;
  };
  evidence_ = MotionEvidence(personAt(0.0), options_);
  for (int i = 1; i <= 10; ++i) {
    see(personAt(0.5 * i));
  }
  EXPECT_TRUE(suffices());
}

TEST_F(MotionEvidenceTest, AFlankLeavesItsPositionAcross) {
  evidence_ = MotionEvidence(flankAt(0.0, 4.0), options_);
  for (int i = 1; i <= 10; ++i) {
    Object object = flankAt(0.0, 4.0);
    object.box.center = Pose2(0.0, 0.5 * i, 0.0);
    see(object);
  }
  EXPECT_TRUE(suffices());
}

TEST_F(MotionEvidenceTest, FromWhereAnEndIsSeenTheDisplacementCounts) {
  evidence_ = MotionEvidence(flankAt(0.0, 4.0), options_);
  for (int i = 1; i <= 10; ++i) {
    see(flankAt(0.5 * i, 4.0));
  }
  see(seenAt(5.5, 4.0));
  EXPECT_FALSE(suffices());
  for (int i = 12; i <= 22; ++i) {
    see(seenAt(0.5 * i, 4.0));
  }
  EXPECT_TRUE(suffices());
}

TEST_F(MotionEvidenceTest, NoneOfItWithoutASpeed) {
  for (int i = 1; i <= 10; ++i) {
    see(seenAt(0.5 * i, 1.0));
  }
  StateEstimate slow = movingEstimate();
  slow.mean[2] = 0.9 * options_.min_speed;
  EXPECT_FALSE(evidence_.suffices(slow, options_));
  StateEstimate uncertain = movingEstimate();
  uncertain.covariance *= 1e4;
  EXPECT_FALSE(evidence_.suffices(uncertain, options_));
}

TEST_F(MotionEvidenceTest, AGrowingSideDoesNotLeaveItsPosition) {
  for (int i = 1; i <= 10; ++i) {
    see(seenAt(0.25 * i, 1.0 + 0.5 * i));
  }
  EXPECT_FALSE(suffices());
}

TEST_F(MotionEvidenceTest, WhatIsOftenSeenAtStaticPositionsIsTakenForOtherObjectsInTurn) {
  for (int i = 1; i <= 30; ++i) {
    Object object = seenAt(0.5 * i, 1.0);
    object.dynamic_state = i % 2 == 0 ? DynamicState::kStatic : DynamicState::kUnknown;
    see(object);
  }
  EXPECT_FALSE(suffices());
  // It leaves them behind, and is known by what it does now.
  for (int i = 31; i <= 45; ++i) {
    see(seenAt(0.5 * i, 1.0));
  }
  EXPECT_TRUE(suffices());
}

TEST_F(MotionEvidenceTest, InFreeSpaceAShorterDisplacementIsEnough) {
  // A box of 4 m goes 2.5 m: it could have stood there half hidden, but not where the map was free.
  MotionEvidence in_unknown_space(seenAt(0.0, 4.0), options_);
  Object free_object = seenAt(0.0, 4.0);
  free_object.moving_fraction = 1.0;
  MotionEvidence in_free_space(free_object, options_);
  for (int i = 1; i <= 10; ++i) {
    for (MotionEvidence* evidence : {&in_unknown_space, &in_free_space}) {
      Object object = seenAt(0.25 * i, 4.0);
      object.moving_fraction = evidence == &in_free_space ? 1.0 : 0.0;
      evidence->predict(0.1, options_);
      evidence->update(object, observedBox(object), kWellPredicted, kDetection, options_);
    }
  }
  EXPECT_FALSE(in_unknown_space.suffices(movingEstimate(), options_));
  EXPECT_TRUE(in_free_space.suffices(movingEstimate(), options_));
}

TEST_F(MotionEvidenceTest, ASideThatComesIntoViewAndGoesOutAgainDoesNotLeaveItsPosition) {
  for (int i = 1; i <= 6; ++i) {
    see(seenAt(0.25 * i, 1.0 + 0.5 * i));  // 4 m long from -0.5 m on
  }
  for (int i = 1; i <= 6; ++i) {
    see(seenAt(1.5 + 0.25 * i, 4.0 - 0.5 * i));  // its last meter
  }
  EXPECT_FALSE(suffices());
}

TEST_F(MotionEvidenceTest, OneJumpIsNoMotion) {
  see(seenAt(0.0, 1.0), 10);
  see(seenAt(10.0, 1.0));
  EXPECT_FALSE(suffices());
}

TEST_F(MotionEvidenceTest, IsolatedEchoesNeedMoreScansThanObjects) {
  const auto scansNeeded = [this](std::size_t points) {
    MotionEvidence evidence(seenAt(0.0, 0.0, points), options_);
    int scans = 0;
    while (!evidence.suffices(movingEstimate(), options_) && scans < 100) {
      ++scans;
      const Object object = seenAt(0.8 * scans, 0.0, points);
      evidence.predict(0.1, options_);
      evidence.update(object, observedBox(object), kWellPredicted, kDetection, options_);
    }
    return scans;
  };
  EXPECT_LT(scansNeeded(2), scansNeeded(1));
  EXPECT_LT(scansNeeded(1), 100);
}

TEST_F(MotionEvidenceTest, TheScoreAddsUpLogLikelihoodRatios) {
  options_.scan_limit = 100.0;
  see(seenAt(0.0, 1.0));
  const double one = std::log(kDetection / options_.false_density);
  EXPECT_NEAR(evidence_.score(), one, 1e-12);
  Object sure = seenAt(0.0, 1.0);
  sure.log_odds = 0.75;
  see(sure);
  EXPECT_NEAR(evidence_.score(), 2.0 * one + 0.75, 1e-12);
  evidence_.miss(kDetection, options_);
  EXPECT_NEAR(evidence_.score(), 2.0 * one + 0.75 + std::log(1.0 - kDetection), 1e-12);
}

TEST_F(MotionEvidenceTest, OneScanCountsForALimitedAmount) {
  see(seenAt(0.0, 1.0));
  EXPECT_DOUBLE_EQ(evidence_.score(), options_.scan_limit);
}

TEST_F(MotionEvidenceTest, AMissWhereNothingCouldBeSeenCostsLittle) {
  see(seenAt(0.0, 1.0), 4);
  const double before = evidence_.score();
  MotionEvidence visible = evidence_;
  visible.miss(0.95, options_);
  evidence_.miss(0.02, options_);
  EXPECT_NEAR(evidence_.score(), before + std::log(0.98), 1e-12);
  EXPECT_NEAR(visible.score(), before + std::log(0.05), 1e-12);
}

TEST_F(MotionEvidenceTest, TheScoreStaysWithinItsLimits) {
  see(seenAt(0.0, 1.0), 100);
  EXPECT_EQ(evidence_.score(), options_.max_evidence);
  for (int i = 0; i < 100; ++i) {
    evidence_.miss(0.5, options_);
  }
  EXPECT_EQ(evidence_.score(), options_.min_evidence);

  see(seenAt(0.0, 1.0));
  constexpr double kFarOff = -20.0;
  evidence_.update(seenAt(0.0, 1.0), observedBox(seenAt(0.0, 1.0)), kFarOff, kDetection, options_);
  EXPECT_EQ(evidence_.score(), options_.min_evidence);
}

TEST_F(MotionEvidenceTest, FreeSpaceIsEvidenceForMotionAndAStaticPositionAgainst) {
  // Just as likely by both filters: only the map decides.
  const auto seemsToStandAfter = [this](const Object& object) {
    MotionEvidence evidence(object, options_);
    const Innovation standing{Eigen::Vector2d::Zero(), 2.0 * object.position_covariance};
    evidence.update(object, observedBox(object), standing.logLikelihood(), kDetection, options_);
    return evidence.seemsToStand();
  };
  EXPECT_FALSE(seemsToStandAfter(objectAt(0.0, 0.0, DynamicState::kMoving)));
  EXPECT_TRUE(seemsToStandAfter(objectAt(0.0, 0.0, DynamicState::kStatic)));
}

TEST_F(MotionEvidenceTest, AfterALongRestMotionIsFoundAsQuickly) {
  see(seenAt(0.0, 1.0), 600);
  int scans = 0;
  while (!suffices() && scans < 100) {
    ++scans;
    see(seenAt(0.5 * scans, 1.0));
  }
  EXPECT_LE(scans, 8);
}

}  // namespace
}  // namespace datmo::motion_evidence_test
