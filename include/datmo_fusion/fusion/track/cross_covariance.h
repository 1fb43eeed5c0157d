// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/tracking/target_motion.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// E[(a - x) (b - x)'] of two estimates a, b of one state x.
using CrossCovariance = TrackCovariance;

/// The covariances of two trackers of one object, at one time.
struct CovariancePair {
  TrackCovariance a;
  TrackCovariance b;
};

/// Errors that are correlated by as much (-1 to 1, 0: independent) along all axes: the correlation
/// times the geometric mean of both covariances, which does not depend on units or axes.
CrossCovariance evenCrossCovariance(const CovariancePair& covariances, double correlation);

/// The cross-covariance after a time step, of two trackers whose gains are not known (Bar-Shalom
/// 1981; Bar-Shalom & Campo 1986).
///
/// Process noise that both share makes their errors alike, measurements make them differ: with the
/// gains K the recursion is (1 - K_a H) (F P_ab F' + Q) (1 - K_b H)'. A linear filter has 1 - K H =
/// P_after (F P_before F' + Q)^-1, which follows from its covariances without its gain; where there
/// was no measurement it is 1.
///
/// Exact for Kalman filters of the model `motion` whose covariances are known before and after each
/// step. Of an IMM filter it is an approximation: its covariance also grows by the spread of its
/// modes, where no error is passed on any more (the factor is kept at 1 or less); and of a step
/// with other times of measurement than its ends.
///
/// `max_correlation` (above 0, below 1): no part of the one error is correlated more with any of
/// the other, so that their joint covariance is positive definite whatever comes in. The
/// covariances must be positive definite.
CrossCovariance steppedCrossCovariance(const CrossCovariance& cross, const CovariancePair& before,
                                       const CovariancePair& after, const LinearMotion& motion,
                                       double max_correlation);

}  // namespace datmo
