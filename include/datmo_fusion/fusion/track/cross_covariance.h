// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/tracking/target_motion.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// E[(a - x) (b - x)'] of two estimates a, b of one state x.
using CrossCovariance = TrackCovariance;

/// The covariances of two trackers of one object, at the same time.
struct CovariancePair {
  TrackCovariance a;
  TrackCovariance b;
};

/// Returns the cross-covariance of errors with the same correlation (-1 to 1, 0: independent) along
/// all axes: the correlation times the geometric mean of both covariances, which does not depend on
/// units or axes.
CrossCovariance evenCrossCovariance(const CovariancePair& covariances, double correlation);

/// Returns the cross-covariance after a time step, for two trackers with unknown gains (Bar-Shalom
/// 1981; Bar-Shalom & Campo 1986).
///
/// Shared process noise correlates their errors, measurements decorrelate them: with the gains K
/// the recursion is (1 - K_a H) (F P_ab F' + Q) (1 - K_b H)'. For a linear filter 1 - K H = P_after
/// (F P_before F' + Q)^-1, which follows from its covariances without its gain; it is 1 if there
/// was no measurement.
///
/// Exact for Kalman filters with the model `motion` whose covariances are known before and after
/// each step. It is an approximation for an IMM filter, whose covariance also grows by the spread
/// of its modes, which passes on no error (the factor is limited to 1), and for a step with
/// measurements at times other than its ends.
///
/// `max_correlation` (above 0, below 1): upper limit for the correlation between any component of
/// one error and any of the other, so that their joint covariance is positive definite for any
/// input. The covariances must be positive definite.
CrossCovariance steppedCrossCovariance(const CrossCovariance& cross, const CovariancePair& before,
                                       const CovariancePair& after, const LinearMotion& motion,
                                       double max_correlation);

}  // namespace datmo
