#include "datmo_fusion/tracking/kalman_filter.h"

#include <cmath>

#include <Eigen/LU>

namespace datmo {

double Innovation::squaredDistance() const { return residual.dot(covariance.inverse() * residual); }

double Innovation::logLikelihood() const {
  return -0.5 * (squaredDistance() + std::log(covariance.determinant())) - std::log(2.0 * kPi);
}

Innovation innovationOf(const StateEstimate& predicted, const PositionMeasurement& measured) {
  return {measured.position - predicted.mean.head<2>(),
          predicted.covariance.topLeftCorner<2, 2>() + measured.covariance};
}

StateEstimate predict(const StateEstimate& estimate, const LinearMotion& motion) {
  return {motion.transition * estimate.mean,
          motion.transition * estimate.covariance * motion.transition.transpose() + motion.noise};
}

StateEstimate update(const StateEstimate& predicted, const PositionMeasurement& measured) {
  const Innovation innovation = innovationOf(predicted, measured);
  const Eigen::Matrix<double, kTrackState, 2> gain =
      predicted.covariance.leftCols<2>() * innovation.covariance.inverse();

  TrackCovariance kept = TrackCovariance::Identity();
  kept.leftCols<2>() -= gain;
  const TrackCovariance covariance = kept * predicted.covariance * kept.transpose() +
                                     gain * measured.covariance * gain.transpose();
  return {predicted.mean + gain * innovation.residual, 0.5 * (covariance + covariance.transpose())};
}

}  // namespace datmo
