// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "datmo_fusion/common/object.h"

namespace datmo {

/// Upper bounds on how far from the middle of an object any target may measure its center with it,
/// and on the uncertainty: what depends on the object alone, computed once for all targets.
struct CenterBound {
  CenterBound() = default;  ///< no object
  explicit CenterBound(const Object& object);

  /// Makes the bounds hold for the objects of the other one, too.
  void widen(const CenterBound& other);

  double diagonal = 0.0;  ///< m
  double share = 0.0;     ///< 0 to 0.5, offset of the centers as a share of both sizes
  /// m^2, in any direction, without the part from the target's size.
  double variance = 0.0;
  double delay = 0.0;       ///< s, at least 0, before or after the time of the targets
  bool hides_side = false;  ///< a side is not visible
};

/// The gate of one target, by bounds only: most objects that are close enough to be considered are
/// far outside of it, and the actual measurement of a target by an object is costly.
struct CenterGate {
  double gate;           ///< largest Mahalanobis distance squared
  double position_std;   ///< m, of the estimate, in any direction
  double speed;          ///< m/s
  double velocity_std;   ///< m/s, in any direction
  double diagonal;       ///< m, of the box
  double share;          ///< 0 to 0.5, largest anchor share
  double size_variance;  ///< m^2, of length or width

  /// Returns the distance (m) of an object's middle from the estimate beyond which TrackedBox
  /// measures no center within the gate.
  double reach(const CenterBound& object) const;
};

/// Returns the largest variance in any direction.
double maxVariance(const Eigen::Matrix2d& covariance);

}  // namespace datmo
