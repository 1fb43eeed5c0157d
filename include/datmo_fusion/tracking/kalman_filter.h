// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/tracking/target_motion.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// A normal distribution over the state of a track.
struct StateEstimate {
  TrackState mean = TrackState::Zero();
  TrackCovariance covariance = TrackCovariance::Identity();
};

/// Where an object was seen: m, fixed frame; covariance m^2, positive definite.
struct PositionMeasurement {
  Point2 position = Point2::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double delay = 0.0;  ///< s after the time of the state: where the object is then at its velocity
};

/// The state with the position to which its velocity takes it in so many seconds, which may be less
/// than 0: other coordinates of the same state.
StateEstimate carriedOn(const StateEstimate& estimate, double seconds);

/// Innovation: measurement minus prediction, of a position (m) or of a velocity (m/s).
struct Innovation {
  Eigen::Vector2d residual;    ///< measured minus predicted
  Eigen::Matrix2d covariance;  ///< of the residual

  /// Mahalanobis distance squared; chi-square with two degrees of freedom where the models hold.
  double squaredDistance() const { return residual.dot(covariance.inverse() * residual); }

  /// Logarithm of the normal density of the residual, of 1/m^2 or 1/(m/s)^2.
  double logLikelihood() const;
};

// In line, as an association asks for many of them.
inline Innovation innovationOf(const StateEstimate& predicted,
                               const PositionMeasurement& measured) {
  if (measured.delay != 0.0) {
    return innovationOf(carriedOn(predicted, measured.delay),
                        PositionMeasurement{measured.position, measured.covariance, 0.0});
  }
  return {measured.position - predicted.mean.head<2>(),
          predicted.covariance.topLeftCorner<2, 2>() + measured.covariance};
}

inline Innovation innovationOf(const StateEstimate& predicted, const MeasuredVelocity& measured) {
  return {measured.velocity - predicted.mean.segment<2>(2),
          predicted.covariance.block<2, 2>(2, 2) + measured.covariance};
}

StateEstimate predict(const StateEstimate& estimate, const LinearMotion& motion);

/// The same, into `result`, which is not `estimate`.
void predict(const StateEstimate& estimate, const LinearMotion& motion, StateEstimate& result);

/// The update of the Kalman filter. What it leaves of the covariance of the position is
/// P - P (P + R)^-1 P, computed as R (P + R)^-1 P: no difference of nearly equal numbers is taken,
/// and the result stays positive without the cost of Joseph's form (Bar-Shalom, Li, Kirubarajan
/// 2001, 5.2.3).
StateEstimate update(const StateEstimate& predicted, const PositionMeasurement& measured);

/// The same with a velocity, in the fixed frame's axes.
StateEstimate update(const StateEstimate& predicted, const MeasuredVelocity& measured);

}  // namespace datmo
