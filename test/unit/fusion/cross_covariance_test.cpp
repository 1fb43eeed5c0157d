// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/cross_covariance.h"

#include "fusion_tracks.h"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

namespace datmo::cross_covariance_test {
namespace {

using JointCovariance = Eigen::Matrix<double, 2 * kTrackState, 2 * kTrackState>;

constexpr double kStep = 0.1;  ///< s
constexpr double kMaxMagnitude = 0.999;

JointCovariance jointOf(const CovariancePair& pair, const CrossCovariance& cross) {
  JointCovariance joint;
  joint << pair.a, cross, cross.transpose(), pair.b;
  return joint;
}

/// Correlation of both errors, each whitened by itself: the largest singular value is the greatest
/// correlation.
double greatestCorrelation(const CovariancePair& pair, const CrossCovariance& cross) {
  const TrackCovariance lower_a = pair.a.llt().matrixL();
  const TrackCovariance lower_b = pair.b.llt().matrixL();
  const TrackCovariance white = lower_a.inverse() * cross * lower_b.inverse().transpose();
  const Eigen::SelfAdjointEigenSolver<TrackCovariance> solver(white * white.transpose());
  return std::sqrt(solver.eigenvalues().maxCoeff());
}

PositionMeasurement measurement(double variance) {
  return {Point2::Zero(), Eigen::Matrix2d::Identity() * variance};
}

/// 1 - K H of a position measurement.
TrackCovariance keptBy(const TrackCovariance& predicted, const PositionMeasurement& measured) {
  const Eigen::Matrix<double, kTrackState, 2> gain =
      predicted.leftCols<2>() *
      innovationOf({TrackState::Zero(), predicted}, measured).covariance.inverse();
  TrackCovariance kept = TrackCovariance::Identity();
  kept.leftCols<2>() -= gain;
  return kept;
}

TEST(CrossCovarianceTest, OneStepIsByHand) {
  // x' = x + w, w of variance 1. Of 3 + 1 = 4 one filter keeps 1, of 1 + 1 = 2 the other keeps 1:
  // (1/4) (0.5 + 1) (1/2).
  const TrackCovariance identity = TrackCovariance::Identity();
  const CrossCovariance cross =
      steppedCrossCovariance(identity * 0.5, {identity * 3.0, identity}, {identity, identity},
                             {identity, identity}, kMaxMagnitude);
  EXPECT_TRUE(cross.isApprox(identity * (0.25 * 1.5 * 0.5), 1e-9));
}

TEST(CrossCovarianceTest, AgreesWithTheGainsOfKalmanFilters) {
  // The second one measures only in every other step, and less accurately; both turn.
  const LinearMotion motion = coordinatedTurn(0.4, TargetMotionOptions(), kStep);
  TrackState variance;
  variance << 1.0, 2.0, 9.0, 4.0, 0.25, 0.25;
  StateEstimate a{TrackState::Zero(), variance.asDiagonal()};
  StateEstimate b{TrackState::Zero(), (2.0 * variance).asDiagonal()};
  CrossCovariance by_gains = CrossCovariance::Zero();
  CrossCovariance recursive = CrossCovariance::Zero();
  for (int step = 1; step <= 5; ++step) {
    const CovariancePair before{a.covariance, b.covariance};
    a = predict(a, motion);
    b = predict(b, motion);
    by_gains = motion.transition * by_gains * motion.transition.transpose() + motion.noise;
    by_gains = keptBy(a.covariance, measurement(0.04)) * by_gains;
    a = update(a, measurement(0.04));
    if (step % 2 == 0) {
      by_gains = by_gains * keptBy(b.covariance, measurement(0.25)).transpose();
      b = update(b, measurement(0.25));
    }
    recursive = steppedCrossCovariance(recursive, before, {a.covariance, b.covariance}, motion,
                                       kMaxMagnitude);
    EXPECT_TRUE(recursive.isApprox(by_gains, 1e-6)) << step;
  }
  EXPECT_GT(greatestCorrelation({a.covariance, b.covariance}, recursive), 0.5);
}

TEST(CrossCovarianceTest, WithoutMeasurementsItGrowsByTheProcessNoise) {
  const LinearMotion motion = coordinatedTurn(0.0, TargetMotionOptions(), kStep);
  Random random(1);
  const CovariancePair before{randomCovariance(random), randomCovariance(random)};
  const CovariancePair after{predict({TrackState::Zero(), before.a}, motion).covariance,
                             predict({TrackState::Zero(), before.b}, motion).covariance};
  const CrossCovariance cross = evenCrossCovariance(before, 0.3);
  const CrossCovariance expected =
      motion.transition * cross * motion.transition.transpose() + motion.noise;
  EXPECT_TRUE(
      steppedCrossCovariance(cross, before, after, motion, kMaxMagnitude).isApprox(expected, 1e-6));
}

TEST(CrossCovarianceTest, AnEvenOneHasItsCorrelation) {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const CovariancePair pair{randomCovariance(random), randomCovariance(random)};
    EXPECT_NEAR(greatestCorrelation(pair, evenCrossCovariance(pair, 0.4)), 0.4, 1e-4);
    EXPECT_EQ(evenCrossCovariance(pair, 0.0), CrossCovariance::Zero());
  }
  const TrackCovariance identity = TrackCovariance::Identity();
  EXPECT_TRUE(
      evenCrossCovariance({identity * 4.0, identity * 9.0}, 0.5).isApprox(identity * 3.0, 1e-9));
}

TEST(CrossCovarianceTest, TheJointCovarianceIsAlwaysPositive) {
  Random random(3);
  constexpr double kLimit = 0.95;
  const LinearMotion motion = coordinatedTurn(0.4, TargetMotionOptions(), kStep);
  CrossCovariance cross = CrossCovariance::Zero();
  CovariancePair before{randomCovariance(random), randomCovariance(random)};
  for (int i = 0; i < 300; ++i) {
    const CovariancePair after{randomCovariance(random), randomCovariance(random)};
    cross = steppedCrossCovariance(cross, before, after, motion, kLimit);
    EXPECT_LE(greatestCorrelation(after, cross), kLimit + 1e-3);
    EXPECT_EQ(Eigen::LLT<JointCovariance>(jointOf(after, cross)).info(), Eigen::Success);
    before = after;
  }
}

TEST(CrossCovarianceTest, GrowingErrorsAreNotPropagated) {
  // An IMM filter's covariance jumps up as another mode gains weight.
  const TrackCovariance identity = TrackCovariance::Identity();
  const CovariancePair before{identity, identity};
  const CovariancePair after{identity * 100.0, identity * 100.0};
  const LinearMotion rest{identity, identity * 1e-3};
  const CrossCovariance cross =
      steppedCrossCovariance(identity * 0.5, before, after, rest, kMaxMagnitude);
  EXPECT_TRUE(cross.isApprox(identity * 0.501, 1e-9));
}

}  // namespace
}  // namespace datmo::cross_covariance_test
