// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "object_sides.h"
#include <Eigen/Core>

#include "datmo_fusion/common/object.h"

namespace datmo {

/// The positions of the sides behind and ahead along x, then along y, m.
using SideVector = Eigen::Matrix<double, 4, 1>;
using SideMatrix = Eigen::Matrix4d;

/// Fusion of two sources: the sides that either saw, their positions and covariance.
struct FusedSides {
  std::array<bool, kBoxSides> seen{};
  SideVector position = SideVector::Zero();
  SideMatrix covariance = SideMatrix::Zero();
  /// Mean displacement of the positions, as a share of a displacement of all sides that the second
  /// source saw.
  double weight_of_b = 0.5;
};

/// Fuses both in information form, in the same axes. A side that a source did not see has no
/// information from it.
FusedSides fusedSides(const ObjectSides& a, const ObjectSides& b);

}  // namespace datmo
