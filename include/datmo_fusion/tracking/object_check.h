// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Returns whether an object can be tracked: all its numbers are finite (side variances may be
/// kHiddenSide), including those of its points, positions and sizes within the bounds of
/// physical_bounds.h, sizes and variances at least 0, shares from 0 to 1, log odds from -1000 to
/// 1000, its delay up to 10 s, and the covariance of its position symmetric and positive definite.
bool isValid(const Object& object);

/// Returns the object in the parent frame of `frame_in_parent`.
Object transformed(const Pose2& frame_in_parent, const Object& object);

}  // namespace datmo
