// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

struct TrackComparisonOptions {
  double gate = 18.5;                ///< 1
  double body_std = 0.3;             ///< m
  double extent_share = 0.25;        ///< 1
  double velocity_std = 0.5;         ///< m/s
  double unrelated_density = 0.002;  ///< 1/m^2

  void visit(OptionVisitor& visitor);
};

/// Result of comparing two tracks.
struct TrackComparison {
  /// 1, Mahalanobis, of position and velocity: chi-square with four degrees of freedom if the two
  /// are one object. Infinity: too far apart for any further comparison.
  double squared_distance = 0.0;
  double log_likelihood_ratio = 0.0;  ///< of "one object" against "two"
};

/// Compares two tracks of different sensors at one time. Symmetric.
///
/// Uses position, velocity and class. The statistical distance sums both covariances as if they
/// were independent: common errors make the tracks agree better than that. Sensors that see
/// different parts of a body disagree about its center by a share of its size, which is not noise
/// of either track; the covariance of a track fused from several sources already includes body_std.
TrackComparison compare(const Track& a, const Track& b, const TrackComparisonOptions& options);

struct ParallelTracksOptions {
  double heading = 0.35;  ///< rad
  double distance = 2.0;  ///< m

  void visit(OptionVisitor& visitor);
};

/// The thesis's test of two trajectories (3.4.2): the mean differences of heading, x and y over the
/// common history must each be below their threshold. Points at other times are interpolated;
/// without common history only the current state counts. Symmetric except for rounding.
bool areParallel(const Track& a, const Track& b, const ParallelTracksOptions& options);

}  // namespace datmo
