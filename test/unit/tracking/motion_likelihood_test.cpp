// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/motion_likelihood.h"

#include <cmath>
#include <initializer_list>

#include <gtest/gtest.h>

namespace datmo::motion_likelihood_test {
namespace {

constexpr std::initializer_list<double> kSpeeds = {2.0};  // m/s
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

TEST(VelocityLogRatio, RestIsStrongerEvidenceAgainstMotionTheMoreCertainItIs) {
  EXPECT_LT(velocityRatio(0.0, 1.0), 0.0);
  EXPECT_LT(velocityRatio(0.0, 0.2), velocityRatio(0.0, 1.0));
  EXPECT_NEAR(velocityRatio(0.0, 1e3), 0.0, 1e-5) << "nothing is known";
}

TEST(VelocityLogRatio, NoVelocityOutweighsApparentMotion) {
  EXPECT_NEAR(velocityRatio(3.0, 0.1), std::log(1.0 / kApparent), 1e-3);
}

TEST(VelocityLogRatio, SpeedsOfSeveralKindsAreAMixture) {
  const Eigen::Matrix2d covariance = 0.25 * Eigen::Matrix2d::Identity();
  const auto ratio = [&](std::initializer_list<double> speeds) {
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
  // However fast it is, an object that the beams do not refute is as likely as its share.
  EXPECT_NEAR(motionLogRatio(evidence(50.0, 0.0, 0.1), 2.0), std::log(10.0), 1e-9);
  EXPECT_NEAR(motionLogRatio(evidence(50.0, 3.0, 0.1), 2.0), std::log(10.0) + 3.0, 1e-9);
}

TEST(MotionLogRatio, SurfacesFacingTheBeamsCountByTheirShare) {
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
