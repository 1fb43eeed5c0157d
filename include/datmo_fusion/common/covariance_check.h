// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "datmo_fusion/common/physical_bounds.h"

namespace datmo {

/// Whether a matrix is a covariance: finite, symmetric and positive definite. Each element is
/// compared with the standard deviations of its row and column: a large variance of one quantity
/// hides nothing of the others.
template <int size>
bool isCovariance(const Eigen::Matrix<double, size, size>& matrix) {
  // Of a negative variance: NaN, with which every comparison fails.
  const Eigen::Array<double, size, 1> deviations = matrix.diagonal().array().sqrt();
  const Eigen::Array<double, size, size> max_difference =
      kMaxAsymmetry * (deviations.matrix() * deviations.matrix().transpose()).array();
  return matrix.allFinite() &&
         ((matrix - matrix.transpose()).array().abs() <= max_difference).all() &&
         matrix.llt().info() == Eigen::Success;
}

}  // namespace datmo
