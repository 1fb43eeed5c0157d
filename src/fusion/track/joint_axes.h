// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Axes in which two covariances a and b are diagonal and sum up to 1, which makes them independent
/// of units: a = axes diag(share) axes', b = axes diag(1 - share) axes'.
///
/// The shares stay away from 0 and 1: a matrix that is not quite positive definite after rounding
/// is replaced by a close one that is. Both must be finite, with variances above 0.
struct JointAxes {
  JointAxes(const TrackCovariance& a, const TrackCovariance& b);

  /// Transforms a covariance from these axes.
  TrackCovariance covariance(const TrackCovariance& in_axes) const;
  TrackCovariance covariance(const TrackState& diagonal) const;

  /// Limits a cross-covariance, given in these axes, so that no component of one error has a
  /// correlation above `max_correlation` (more than 0) with any of the other. Below 1 that makes
  /// both errors' joint covariance positive definite.
  TrackCovariance limitedCross(const TrackCovariance& cross, double max_correlation) const;

  TrackCovariance axes;
  TrackCovariance inverse;  ///< of `axes`
  TrackState share;         ///< share of a in the sum
};

}  // namespace datmo
