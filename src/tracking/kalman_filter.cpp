// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/kalman_filter.h"

#include <cmath>

#include <Eigen/LU>

namespace datmo {

namespace {

/// Rounding must not make the two halves drift apart.
void symmetrize(TrackCovariance& covariance) {
  covariance.triangularView<Eigen::StrictlyLower>() = covariance.transpose();
}

PositionMeasurement undelayed(PositionMeasurement measured) {
  measured.delay = 0.0;
  return measured;
}

}  // namespace

double Innovation::squaredDistance() const { return residual.dot(covariance.inverse() * residual); }

double Innovation::logLikelihood() const {
  return -0.5 * (squaredDistance() + std::log(covariance.determinant())) - std::log(2.0 * kPi);
}

StateEstimate carriedOn(const StateEstimate& estimate, double seconds) {
  StateEstimate result = estimate;
  result.mean.head<2>() += seconds * result.mean.segment<2>(2);
  result.covariance.topRows<2>() += seconds * result.covariance.middleRows<2>(2);
  result.covariance.leftCols<2>() += seconds * result.covariance.middleCols<2>(2);
  return result;
}

Innovation innovationOf(const StateEstimate& predicted, const PositionMeasurement& measured) {
  if (measured.delay != 0.0) {
    return innovationOf(carriedOn(predicted, measured.delay), undelayed(measured));
  }
  return {measured.position - predicted.mean.head<2>(),
          predicted.covariance.topLeftCorner<2, 2>() + measured.covariance};
}

Innovation innovationOf(const StateEstimate& predicted, const MeasuredVelocity& measured) {
  return {measured.velocity - predicted.mean.segment<2>(2),
          predicted.covariance.block<2, 2>(2, 2) + measured.covariance};
}

StateEstimate predict(const StateEstimate& estimate, const LinearMotion& motion) {
  // With the position p and the rest r of the state, a motion is p' = p + A r and r' = B r.
  const Eigen::Matrix<double, 2, 4> a = motion.transition.topRightCorner<2, 4>();
  const Eigen::Matrix4d b = motion.transition.bottomRightCorner<4, 4>();
  const Eigen::Matrix2d position = estimate.covariance.topLeftCorner<2, 2>();
  const Eigen::Matrix<double, 2, 4> cross = estimate.covariance.topRightCorner<2, 4>();
  const Eigen::Matrix4d rest = estimate.covariance.bottomRightCorner<4, 4>();
  const Eigen::Matrix<double, 2, 4> moved = cross + a * rest;

  StateEstimate result;
  result.mean.head<2>() = estimate.mean.head<2>() + a * estimate.mean.tail<4>();
  result.mean.tail<4>() = b * estimate.mean.tail<4>();
  TrackCovariance& covariance = result.covariance;
  covariance.topLeftCorner<2, 2>() = position + cross * a.transpose() + a * moved.transpose();
  covariance.topRightCorner<2, 4>() = moved * b.transpose();
  covariance.bottomRightCorner<4, 4>() = b * rest * b.transpose();
  covariance += motion.noise;
  symmetrize(covariance);
  return result;
}

StateEstimate update(const StateEstimate& predicted, const PositionMeasurement& measured) {
  if (measured.delay != 0.0) {
    const StateEstimate then = carriedOn(predicted, measured.delay);
    return carriedOn(update(then, undelayed(measured)), -measured.delay);
  }
  const Innovation innovation = innovationOf(predicted, measured);
  const Eigen::Matrix2d weight = innovation.covariance.inverse();
  const Eigen::Matrix2d kept = measured.covariance * weight;
  const Eigen::Matrix2d position = predicted.covariance.topLeftCorner<2, 2>();
  const Eigen::Matrix<double, 2, 4> cross = predicted.covariance.topRightCorner<2, 4>();
  const Eigen::Matrix<double, 4, 2> gain = cross.transpose() * weight;

  StateEstimate result;
  result.mean.head<2>() = predicted.mean.head<2>() + position * (weight * innovation.residual);
  result.mean.tail<4>() = predicted.mean.tail<4>() + gain * innovation.residual;
  result.covariance.topLeftCorner<2, 2>() = kept * position;
  result.covariance.topRightCorner<2, 4>() = kept * cross;
  result.covariance.bottomRightCorner<4, 4>() =
      predicted.covariance.bottomRightCorner<4, 4>() - gain * cross;
  symmetrize(result.covariance);
  return result;
}

StateEstimate update(const StateEstimate& predicted, const MeasuredVelocity& measured) {
  const Innovation innovation = innovationOf(predicted, measured);
  const Eigen::Matrix<double, kTrackState, 2> of_velocity = predicted.covariance.middleCols<2>(2);
  const Eigen::Matrix<double, kTrackState, 2> gain = of_velocity * innovation.covariance.inverse();
  // Joseph's form: the covariance stays positive however sure the measurement is.
  TrackCovariance kept = TrackCovariance::Identity();
  kept.middleCols<2>(2) -= gain;
  StateEstimate result;
  result.mean = predicted.mean + gain * innovation.residual;
  result.covariance = kept * predicted.covariance * kept.transpose() +
                      gain * measured.covariance * gain.transpose();
  symmetrize(result.covariance);
  return result;
}

}  // namespace datmo
