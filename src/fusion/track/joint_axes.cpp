// SPDX-License-Identifier: BSD-3-Clause
#include "joint_axes.h"

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace datmo {

namespace {

/// Minimum share of the sum along any axis: rounding leaves no significant digits below it.
constexpr double kMinShare = 1e-12;

/// Added to both variances (relative to a sum of 1) so that the Cholesky factor of the sum is
/// accurate; and the growth factor if that is not enough.
constexpr double kFirstRepair = 1e-12;
constexpr double kNextRepair = 10.0;

/// A cross-covariance whose correlations have a larger norm is invalid, and only its directions
/// count: singular values below the square root of the largest one's rounding would be lost.
constexpr double kMaxNorm = 10.0;

using Solver = Eigen::SelfAdjointEigenSolver<TrackCovariance>;

/// Uses forward substitution. Eigen solves many right-hand sides at once with kernels for large
/// matrices, which takes several times as long.
TrackCovariance inverseOfLower(const TrackCovariance& lower) {
  TrackCovariance inverse = TrackCovariance::Zero();
  for (int column = 0; column < kTrackState; ++column) {
    inverse(column, column) = 1.0 / lower(column, column);
    for (int row = column + 1; row < kTrackState; ++row) {
      double sum = 0.0;
      for (int i = column; i < row; ++i) {
        sum += lower(row, i) * inverse(i, column);
      }
      inverse(row, column) = -sum / lower(row, row);
    }
  }
  return inverse;
}

}  // namespace

JointAxes::JointAxes(const TrackCovariance& a, const TrackCovariance& b) {
  const TrackState scale = (a + b).diagonal().cwiseSqrt();
  const TrackState to_scale = scale.cwiseInverse();
  TrackCovariance part = to_scale.asDiagonal() * a * to_scale.asDiagonal();
  TrackCovariance sum = part + to_scale.asDiagonal() * b * to_scale.asDiagonal();
  Eigen::LLT<TrackCovariance> factors;
  double repair = kFirstRepair;
  do {
    part.diagonal().array() += repair;
    sum.diagonal().array() += 2.0 * repair;
    factors.compute(sum);
    repair *= kNextRepair;
  } while (factors.info() != Eigen::Success && repair < kTrackState);
  const TrackCovariance lower = factors.matrixL();
  const TrackCovariance whitening = inverseOfLower(lower);
  const TrackCovariance whitened = whitening * part * whitening.transpose();
  const Solver solver(0.5 * (whitened + whitened.transpose()));
  share = solver.eigenvalues().cwiseMax(kMinShare).cwiseMin(1.0 - kMinShare);
  axes = scale.asDiagonal() * (lower * solver.eigenvectors());
  inverse = solver.eigenvectors().transpose() * whitening * to_scale.asDiagonal();
}

TrackCovariance JointAxes::covariance(const TrackCovariance& in_axes) const {
  const TrackCovariance result = axes * in_axes * axes.transpose();
  return 0.5 * (result + result.transpose());
}

TrackCovariance JointAxes::covariance(const TrackState& diagonal) const {
  return covariance(TrackCovariance(diagonal.asDiagonal()));
}

TrackCovariance JointAxes::limitedCross(const TrackCovariance& cross,
                                        double max_correlation) const {
  const TrackState std_a = share.cwiseSqrt();
  const TrackState std_b = (1.0 - share.array()).sqrt();
  TrackCovariance in_axes = inverse * cross * inverse.transpose();
  TrackCovariance correlations =
      std_a.cwiseInverse().asDiagonal() * in_axes * std_b.cwiseInverse().asDiagonal();
  const double norm = correlations.norm();
  if (norm <= max_correlation) {
    return in_axes;  // no singular value exceeds it
  }
  correlations *= std::min(1.0, kMaxNorm / norm);
  const Solver solver(correlations.transpose() * correlations);
  const TrackState singular = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const TrackState kept = max_correlation * singular.cwiseMax(max_correlation).cwiseInverse();
  return std_a.asDiagonal() * correlations * solver.eigenvectors() * kept.asDiagonal() *
         solver.eigenvectors().transpose() * std_b.asDiagonal();
}

}  // namespace datmo
