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

/// Two sources together: the sides that either saw, their positions and covariance.
struct FusedSides {
  std::array<bool, kBoxSides> seen{};
  SideVector position = SideVector::Zero();
  SideMatrix covariance = SideMatrix::Zero();
  /// How far the positions move, on average, as a share of a motion of all that the second one saw.
  double weight_of_b = 0.5;
};

/// Both in information form, in the same axes. A side that one did not see has no information of
/// that one.
FusedSides fusedSides(const ObjectSides& a, const ObjectSides& b);

}  // namespace datmo
