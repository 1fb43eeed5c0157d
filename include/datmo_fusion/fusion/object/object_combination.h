// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/object.h"

namespace datmo {

/// Fuses two observations of one object by two sensors, in a common frame (thesis 3.3.3).
///
/// Position and size: each sensor measures the positions of the sides that it saw, with covariance
/// A P A' + V, where P moves the box as a whole (A: to each side) and V holds the sides' own
/// variances. The positions are fused in information form, which for points is the thesis's (x_a /
/// P_a + x_b / P_b) / (1 / P_a + 1 / P_b). A side seen by one sensor only is as that one saw it; a
/// side seen by neither is no nearer than either surely says. The observation time (`delay`) is
/// weighted like the position, which is exact for any constant velocity.
///
/// Classes are fused by Bayes; the result is moving if either says so, else static if either says
/// so. Log odds are summed, as for independent detectors. The points are those of the object with
/// the more certain position, since they serve for exact positions. Both must be valid (isValid).
Object combined(const Object& a, const Object& b);

}  // namespace datmo
