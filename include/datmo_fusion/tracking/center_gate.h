// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "datmo_fusion/common/object.h"

namespace datmo {

/// How far from the middle of an object any target may measure its center by it, and how surely, at
/// most: what is known of the object alone, once for all targets.
struct CenterBound {
  CenterBound() = default;  ///< of no object
  explicit CenterBound(const Object& object);

  /// Holds for an object of the other bound as well.
  void widen(const CenterBound& other);

  double diagonal = 0.0;  ///< m
  double share = 0.0;     ///< 0 to 0.5, by which the centers lie apart: of both sizes
  /// m^2, in any direction, but for what the size of the target adds.
  double variance = 0.0;
  double delay = 0.0;       ///< s, at least 0: after or before the time of the targets
  bool hides_side = false;  ///< a side was not seen
};

/// The gate of one target, by bounds alone: most objects that are near enough to be looked at are
/// far outside of it, and what a target measures by an object takes long to work out.
struct CenterGate {
  double gate;           ///< largest Mahalanobis distance squared
  double position_std;   ///< m, of the estimate, in any direction
  double speed;          ///< m/s
  double velocity_std;   ///< m/s, in any direction
  double diagonal;       ///< m, of the box
  double share;          ///< 0 to 0.5, largest anchor share
  double size_variance;  ///< m^2, of length or width

  /// m: by an object whose middle lies farther from the estimate than this, TrackedBox measures no
  /// center within the gate.
  double reach(const CenterBound& object) const;
};

/// Largest variance in any direction.
double maxVariance(const Eigen::Matrix2d& covariance);

}  // namespace datmo
