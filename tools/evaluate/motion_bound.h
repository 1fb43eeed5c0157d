// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "datmo_fusion/common/pose2.h"

namespace datmo::evaluation {

/// How well a moving object can be distinguished from a stationary one by an observer who knows its
/// shape, its heading and which beams end on it, but neither position nor velocity. Only the noise
/// of the observations is a limit.
///
/// An observation k is of the object's position along some axes; its Fisher information is J_k (2 x
/// 2). s_k: true displacement since the first one. With the stationary alternative at the unknown
/// position p that explains the observations best, the expected log-likelihood ratio of the true
/// motion to standing is
///
///     L = 1/2 min_p sum_k (s_k - p)' J_k (s_k - p) = 1/2 (c - b' A^+ b),
///     A = sum J_k, b = sum J_k s_k, c = sum s_k' J_k s_k.
///
/// At a constant velocity, s_k = v t_k, this is 1/2 v' I_v v, with the information of the velocity
/// after the unknown position is marginalized (Schur complement):
///
///     I_v = sum t_k^2 J_k - (sum t_k J_k) (sum J_k)^+ (sum t_k J_k).
class MotionBound {
 public:
  /// A range on a plane side with the outward `normal`, by a beam along `direction` (unit vectors,
  /// not perpendicular). The range r = n'(p - o) / n'd to the side through p changes with p by n /
  /// n'd: the information is n n' / (sigma n'd)^2, the standard deviation along the normal sigma
  /// |n'd|. `sigma`: of the range, m, greater than 0.
  void addRange(const Point2& displacement, const Point2& direction, const Point2& normal,
                double sigma);

  /// The position along `axis` (unit vector) is uniform in an interval of `width` (m, greater than
  /// 0): beams hit or miss. It is modeled as a normal distribution with the same variance, width^2
  /// / 12.
  void addInterval(const Point2& displacement, const Point2& axis, double width);

  /// L, at least 0; 0 with fewer than two observations.
  double logRatio() const;

 private:
  void add(const Point2& displacement, const Point2& gradient);

  Eigen::Matrix2d information_ = Eigen::Matrix2d::Zero();  // A
  Point2 weighted_ = Point2::Zero();                       // b
  double squared_ = 0.0;                                   // c
};

}  // namespace datmo::evaluation
