#include "joint_axes.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace datmo {

namespace {

using Solver = Eigen::SelfAdjointEigenSolver<TrackCovariance>;

/// Of the sum, that either has along any axis.
constexpr double kLeastShare = 1e-9;

/// Added to a correlation matrix that rounding has left without a Cholesky factor, and by how much
/// more where that does not suffice.
constexpr double kFirstRepair = 1e-12;
constexpr double kNextRepair = 10.0;

/// Of a correlation matrix.
TrackCovariance lowerFactor(TrackCovariance matrix) {
  Eigen::LLT<TrackCovariance> factors(matrix);
  for (double repair = kFirstRepair; factors.info() != Eigen::Success && repair < kTrackState;
       repair *= kNextRepair) {
    matrix.diagonal().array() += repair;
    factors.compute(matrix);
  }
  return factors.matrixL();
}

}  // namespace

JointAxes::JointAxes(const TrackCovariance& a, const TrackCovariance& b) {
  const TrackCovariance sum = a + b;
  const TrackState scale = sum.diagonal().cwiseSqrt();
  const TrackState to_scale = scale.cwiseInverse();
  const TrackCovariance lower = lowerFactor(to_scale.asDiagonal() * sum * to_scale.asDiagonal());
  const TrackCovariance half = lower.triangularView<Eigen::Lower>().solve(
      TrackCovariance(to_scale.asDiagonal() * a * to_scale.asDiagonal()));
  const TrackCovariance whitened =
      lower.triangularView<Eigen::Lower>().solve(TrackCovariance(half.transpose()));
  const Solver solver(0.5 * (whitened + whitened.transpose()));
  share = solver.eigenvalues().cwiseMax(kLeastShare).cwiseMin(1.0 - kLeastShare);
  axes = scale.asDiagonal() * lower * solver.eigenvectors();
  inverse =
      lower.transpose().triangularView<Eigen::Upper>().solve(solver.eigenvectors()).transpose() *
      to_scale.asDiagonal();
}

TrackCovariance JointAxes::covariance(const TrackCovariance& in_axes) const {
  const TrackCovariance result = axes * in_axes * axes.transpose();
  return 0.5 * (result + result.transpose());
}

TrackCovariance JointAxes::covariance(const TrackState& diagonal) const {
  return covariance(TrackCovariance(diagonal.asDiagonal()));
}

TrackCovariance JointAxes::limitedCross(const TrackCovariance& cross,
                                        double most_correlation) const {
  const TrackState std_a = share.cwiseSqrt();
  const TrackState std_b = (1.0 - share.array()).sqrt();
  const TrackCovariance in_axes = inverse * cross * inverse.transpose();
  const TrackCovariance correlations =
      std_a.cwiseInverse().asDiagonal() * in_axes * std_b.cwiseInverse().asDiagonal();
  // The root of the sum of squares is no less than the largest singular value.
  if (correlations.squaredNorm() <= most_correlation * most_correlation) {
    return in_axes;
  }
  const Solver solver(correlations.transpose() * correlations);
  const TrackState kept =
      (most_correlation /
       solver.eigenvalues().array().max(most_correlation * most_correlation).sqrt());
  return std_a.asDiagonal() * correlations * solver.eigenvectors() * kept.asDiagonal() *
         solver.eigenvectors().transpose() * std_b.asDiagonal();
}

}  // namespace datmo
