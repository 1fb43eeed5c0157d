// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/kalman_filter.h"

#include <cmath>
#include <random>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace datmo::kalman_filter_test {
namespace {

/// 95 % bounds of the mean of `count` chi-square values with `degrees` degrees of freedom; normal
/// for the large counts used here.
struct ChiSquareMean {
  double min;
  double max;
  ChiSquareMean(int degrees, int count)
      : min(degrees - 1.96 * std::sqrt(2.0 * degrees / count)),
        max(degrees + 1.96 * std::sqrt(2.0 * degrees / count)) {}
};

TEST(KalmanFilter, UpdateByHand) {
  StateEstimate predicted;
  predicted.mean << 10.0, 0.0, 2.0, 0.0, 0.0, 0.0;
  predicted.covariance.setIdentity();
  predicted.covariance.diagonal().head<2>().setConstant(3.0);
  predicted.covariance(0, 2) = predicted.covariance(2, 0) = 1.5;
  const StateEstimate updated =
      update(predicted, PositionMeasurement{Point2(14.0, 0.0), Eigen::Matrix2d::Identity()});
  // Gain 3/4 on the position, 1.5/4 on the velocity.
  EXPECT_NEAR(updated.mean[0], 13.0, 1e-12);
  EXPECT_NEAR(updated.mean[2], 3.5, 1e-12);
  EXPECT_NEAR(updated.covariance(0, 0), 0.75, 1e-12);
  EXPECT_NEAR(updated.covariance(2, 2), 1.0 - 1.5 * 1.5 / 4.0, 1e-12);
  EXPECT_NEAR(updated.covariance(0, 2), 1.5 / 4.0, 1e-12);
}

TEST(KalmanFilter, InnovationByHand) {
  StateEstimate predicted;
  predicted.covariance = 3.0 * TrackCovariance::Identity();
  const Innovation innovation =
      innovationOf(predicted, PositionMeasurement{Point2(2.0, -4.0), Eigen::Matrix2d::Identity()});
  EXPECT_NEAR(innovation.squaredDistance(), 20.0 / 4.0, 1e-12);
  EXPECT_NEAR(innovation.logLikelihood(), std::log(std::exp(-2.5) / (2.0 * kPi * 4.0)), 1e-12);
}

TEST(KalmanFilter, VelocityUpdateByHand) {
  StateEstimate predicted;
  predicted.mean << 10.0, 0.0, 2.0, 0.0, 0.0, 0.0;
  predicted.covariance.setIdentity();
  predicted.covariance(2, 2) = predicted.covariance(3, 3) = 3.0;
  predicted.covariance(0, 2) = predicted.covariance(2, 0) = 1.5;
  const StateEstimate updated =
      update(predicted, MeasuredVelocity{{6.0, 0.0}, Eigen::Matrix2d::Identity()});
  // Gain 3/4 on the velocity, 1.5/4 on the position.
  EXPECT_NEAR(updated.mean[2], 5.0, 1e-12);
  EXPECT_NEAR(updated.mean[0], 11.5, 1e-12);
  EXPECT_NEAR(updated.covariance(2, 2), 0.75, 1e-12);
  EXPECT_NEAR(updated.covariance(0, 0), 1.0 - 1.5 * 1.5 / 4.0, 1e-12);
  EXPECT_NEAR(updated.covariance(0, 2), 1.5 / 4.0, 1e-12);
  EXPECT_NEAR(updated.covariance(4, 4), 1.0, 1e-12);
}

/// The same as a measurement of position + delay * velocity, in textbook form.
TEST(KalmanFilter, DelayedMeasurementIsExtrapolatedWithTheVelocity) {
  constexpr double kDelay = 0.3;
  StateEstimate predicted;
  predicted.mean << 1.0, 2.0, 3.0, -4.0, 0.5, 0.1;
  TrackCovariance root = TrackCovariance::Identity();
  root(2, 0) = 0.4;
  root(3, 1) = -0.7;
  root(4, 2) = 0.2;
  predicted.covariance = root * root.transpose();
  const PositionMeasurement measured{Point2(2.5, 0.1), 0.2 * Eigen::Matrix2d::Identity(), kDelay};

  Eigen::Matrix<double, 2, 6> observed = Eigen::Matrix<double, 2, 6>::Zero();
  observed.leftCols<2>().setIdentity();
  observed.middleCols<2>(2) = kDelay * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d residual = measured.position - observed * predicted.mean;
  const Eigen::Matrix2d spread =
      observed * predicted.covariance * observed.transpose() + measured.covariance;
  const Eigen::Matrix<double, 6, 2> gain =
      predicted.covariance * observed.transpose() * spread.inverse();

  const Innovation innovation = innovationOf(predicted, measured);
  EXPECT_TRUE(innovation.residual.isApprox(residual, 1e-12));
  EXPECT_TRUE(innovation.covariance.isApprox(spread, 1e-12));
  const StateEstimate updated = update(predicted, measured);
  EXPECT_TRUE(updated.mean.isApprox(predicted.mean + gain * residual, 1e-12));
  EXPECT_TRUE(updated.covariance.isApprox(
      predicted.covariance - gain * observed * predicted.covariance, 1e-12));
}

TEST(KalmanFilter, CovarianceStaysSymmetricAndPositiveWithExtremeMeasurements) {
  StateEstimate estimate;
  estimate.covariance *= 1e6;
  for (int i = 0; i < 1000; ++i) {
    const double variance = i % 2 == 0 ? 1e-8 : 1e8;
    estimate = predict(estimate, constantAcceleration(TargetMotionOptions(), 0.05));
    estimate = update(estimate,
                      PositionMeasurement{Point2::Zero(), Eigen::Matrix2d::Identity() * variance});
  }
  EXPECT_TRUE(estimate.covariance.isApprox(estimate.covariance.transpose(), 1e-12));
  const Eigen::SelfAdjointEigenSolver<TrackCovariance> solver(estimate.covariance);
  EXPECT_GT(solver.eigenvalues().minCoeff(), 0.0);
}

/// Objects that move by each model are tracked by the same model with consistent covariances.
class Consistency : public testing::TestWithParam<int> {
 protected:
  Eigen::VectorXd normal(Eigen::Index size) {
    Eigen::VectorXd values(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      values[i] = distribution_(engine_);
    }
    return values;
  }

  TrackState drawn(const TrackCovariance& covariance) {
    // The semi-definite noise of a short step is not safe for LLT.
    const Eigen::SelfAdjointEigenSolver<TrackCovariance> solver(covariance);
    return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
           normal(kTrackState);
  }

 private:
  std::mt19937_64 engine_{17};
  std::normal_distribution<double> distribution_{0.0, 1.0};
};

TEST_P(Consistency, NormalizedErrorsAreChiSquare) {
  constexpr int kRuns = 400;
  constexpr int kSteps = 50;
  const LinearMotion motion =
      targetMotions(TargetMotionOptions(), 0.1)[static_cast<std::size_t>(GetParam())];
  const Eigen::Matrix2d noise = Eigen::Vector2d(0.04, 0.25).asDiagonal();
  StateEstimate start;
  start.covariance.diagonal() << 1.0, 1.0, 25.0, 25.0, 0.25, 0.25;
  double error_sum = 0.0;       // NEES at the last step
  double innovation_sum = 0.0;  // NIS over all steps
  for (int run = 0; run < kRuns; ++run) {
    TrackState truth = drawn(start.covariance);
    StateEstimate estimate = start;
    for (int step = 0; step < kSteps; ++step) {
      truth = motion.transition * truth + drawn(motion.noise);
      const Point2 seen = truth.head<2>() + noise.llt().matrixL() * normal(2);
      estimate = predict(estimate, motion);
      innovation_sum += innovationOf(estimate, PositionMeasurement{seen, noise}).squaredDistance();
      estimate = update(estimate, PositionMeasurement{seen, noise});
    }
    const TrackState error = truth - estimate.mean;
    error_sum += error.dot(estimate.covariance.ldlt().solve(error));
  }
  const ChiSquareMean nees(kTrackState, kRuns);
  EXPECT_GT(error_sum / kRuns, nees.min);
  EXPECT_LT(error_sum / kRuns, nees.max);
  const ChiSquareMean nis(2, kRuns * kSteps);
  EXPECT_GT(innovation_sum / (kRuns * kSteps), nis.min);
  EXPECT_LT(innovation_sum / (kRuns * kSteps), nis.max);
}

INSTANTIATE_TEST_SUITE_P(Modes, Consistency, testing::Range(0, kMotionModes));

}  // namespace
}  // namespace datmo::kalman_filter_test
