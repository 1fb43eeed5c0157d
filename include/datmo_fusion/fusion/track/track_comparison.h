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

/// Whether two tracks are of one object.
struct TrackComparison {
  /// 1, Mahalanobis, of position and velocity: chi-square with four degrees of freedom where the
  /// two are one. Infinity: so far from each other that nothing more was looked at.
  double squared_distance = 0.0;
  double log_likelihood_ratio = 0.0;  ///< of "one object" against "two"
};

/// Compares two tracks of different sensors at one time. Symmetric.
///
/// By position, velocity and class. The statistical distance has both covariances as if they were
/// independent: what errors the two have in common makes them agree better than that. What two
/// sensors take for the center of a body differs by which parts of it they see, by a share of its
/// size, and that is no noise of either track; one that was fused of several has body_std in its
/// covariance already.
TrackComparison compare(const Track& a, const Track& b, const TrackComparisonOptions& options);

struct ParallelTracksOptions {
  double heading = 0.35;  ///< rad
  double distance = 2.0;  ///< m

  void visit(OptionVisitor& visitor);
};

/// The thesis's test of two trajectories (3.4.2): means of the differences of heading, x and y over
/// the history that both have in common, each below its threshold. Points of other times are
/// interpolated; without common history the present counts alone. Symmetric but for rounding.
bool areParallel(const Track& a, const Track& b, const ParallelTracksOptions& options);

}  // namespace datmo
