// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Axes in which two covariances a and b are diagonal and sum up to 1, so that units have no part
/// in it: a = axes diag(share) axes', b = axes diag(1 - share) axes'.
///
/// The shares keep clear of 0 and 1: of a matrix that rounding has left not quite positive
/// definite, a near one is taken that is. Both must be finite, with variances above 0.
struct JointAxes {
  JointAxes(const TrackCovariance& a, const TrackCovariance& b);

  /// From these axes.
  TrackCovariance covariance(const TrackCovariance& in_axes) const;
  TrackCovariance covariance(const TrackState& diagonal) const;

  /// A cross-covariance, given in these axes, with no correlation between any part of the one error
  /// and any of the other above `max_correlation` (more than 0). Below 1 that makes both errors'
  /// joint covariance positive definite.
  TrackCovariance limitedCross(const TrackCovariance& cross, double max_correlation) const;

  TrackCovariance axes;
  TrackCovariance inverse;  ///< of `axes`
  TrackState share;         ///< of a in the sum
};

}  // namespace datmo
