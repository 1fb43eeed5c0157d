// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/motion_bound.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

namespace datmo::evaluation {

void MotionBound::addRange(const Point2& displacement, const Point2& direction,
                           const Point2& normal, double sigma) {
  add(displacement, normal / (sigma * normal.dot(direction)));
}

void MotionBound::addInterval(const Point2& displacement, const Point2& axis, double width) {
  add(displacement, axis * std::sqrt(12.0) / width);
}

double MotionBound::logRatio() const {
  // Rank-revealing: the position along a side of which no end is visible is not observed.
  const Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix2d> information(information_);
  const Point2 standing = information.solve(weighted_);
  return std::max(0.0, 0.5 * (squared_ - weighted_.dot(standing)));
}

void MotionBound::add(const Point2& displacement, const Point2& gradient) {
  const double along = gradient.dot(displacement);
  information_ += gradient * gradient.transpose();
  weighted_ += along * gradient;
  squared_ += along * along;
}

}  // namespace datmo::evaluation
