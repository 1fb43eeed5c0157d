// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/tracking/target_motion.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Gaussian estimate of a track's state.
struct StateEstimate {
  TrackState mean = TrackState::Zero();
  TrackCovariance covariance = TrackCovariance::Identity();
};

/// A measured position: m, fixed frame; covariance m^2, positive definite.
struct PositionMeasurement {
  Point2 position = Point2::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double delay = 0.0;  ///< s after the time of the state; the object has moved on until then
};

/// Returns the state with its position extrapolated by its velocity over this many seconds, which
/// may be negative: a change of coordinates of the same state.
StateEstimate carriedOn(const StateEstimate& estimate, double seconds);

/// Innovation: measurement minus prediction, of a position (m) or of a velocity (m/s).
struct Innovation {
  Eigen::Vector2d residual;    ///< measured minus predicted
  Eigen::Matrix2d covariance;  ///< of the residual

  /// Returns the squared Mahalanobis distance; chi-square with two degrees of freedom if the models
  /// hold.
  double squaredDistance() const { return residual.dot(covariance.inverse() * residual); }

  /// Returns the log of the normal density of the residual, in 1/m^2 or 1/(m/s)^2.
  double logLikelihood() const;
};

// Inline, because association calls it often.
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

/// The same, into `result`, which must not be `estimate`.
void predict(const StateEstimate& estimate, const LinearMotion& motion, StateEstimate& result);

/// Kalman filter update. The updated position covariance P - P (P + R)^-1 P is computed as
/// R (P + R)^-1 P: this avoids differences of nearly equal numbers, and stays positive definite
/// without the cost of Joseph's form (Bar-Shalom, Li, Kirubarajan 2001, 5.2.3).
StateEstimate update(const StateEstimate& predicted, const PositionMeasurement& measured);

/// The same with a velocity, along the fixed frame's axes.
StateEstimate update(const StateEstimate& predicted, const MeasuredVelocity& measured);

}  // namespace datmo
