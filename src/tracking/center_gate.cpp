// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/center_gate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Bounds on the rounding error of distances (m) and, as a share, of variances.
constexpr double kRoundedDistance = 1e-6;
constexpr double kRoundedShare = 1e-9;

/// Adds the bounds from the sides along one axis. See measured() in tracked_box.cpp.
void addAxis(double one, double opposite, CenterBound& bound) {
  if (std::isfinite(one) && std::isfinite(opposite)) {
    const double sum = one + opposite;
    bound.share = std::max(bound.share, sum > 0.0 ? 0.5 * std::abs(one - opposite) / sum : 0.0);
  } else {
    bound.share = 0.5;
    bound.hides_side = true;
  }
}

}  // namespace

double maxVariance(const Eigen::Matrix2d& covariance) {
  const double half_difference = 0.5 * (covariance(0, 0) - covariance(1, 1));
  return 0.5 * covariance.trace() + std::sqrt(square(half_difference) + square(covariance(0, 1)));
}

CenterBound::CenterBound(const Object& object)
    : diagonal(std::hypot(object.box.length, object.box.width)) {
  const auto& sides = object.side_variance;
  addAxis(sides[static_cast<std::size_t>(BoxSide::kFront)],
          sides[static_cast<std::size_t>(BoxSide::kRear)], *this);
  addAxis(sides[static_cast<std::size_t>(BoxSide::kLeft)],
          sides[static_cast<std::size_t>(BoxSide::kRight)], *this);
  double of_side = 0.0;
  for (const double side : sides) {
    of_side = std::isfinite(side) ? std::max(of_side, side) : of_side;
  }
  variance = maxVariance(object.position_covariance) + of_side;
  delay = std::abs(object.delay);
}

void CenterBound::widen(const CenterBound& other) {
  diagonal = std::max(diagonal, other.diagonal);
  share = std::max(share, other.share);
  variance = std::max(variance, other.variance);
  delay = std::max(delay, other.delay);
  hides_side = hides_side || other.hides_side;
}

double CenterGate::reach(const CenterBound& object) const {
  // Errors of position and velocity may be correlated.
  double total = square(position_std + object.delay * velocity_std) + object.variance +
                 square(share + object.share) * size_variance;
  if (object.hides_side) {  // possibly both of two opposite ones
    total += kUniformVariance * (square(diagonal) + size_variance);
  }
  const double apart =
      object.delay * speed + object.share * (diagonal + object.diagonal) + kRoundedDistance;
  return apart + std::sqrt(gate * total) * (1.0 + kRoundedShare);
}

}  // namespace datmo
