// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/object.h"

namespace datmo {

/// Two objects that two sensors saw, taken for one, in the frame of both (thesis 3.3.3).
///
/// Position and size: each sensor measures the positions of the sides that it saw, with covariance
/// A P A' + V, where P moves the box as a whole (A: to each side) and V holds the sides' own
/// variances. The positions are fused in information form, which for points is the thesis's
/// (x_a / P_a + x_b / P_b) / (1 / P_a + 1 / P_b). A side that one did not see is as the other saw
/// it; one that neither saw is no nearer than either surely says. The time the object is seen at
/// (`delay`) is weighted as its position is: right for all constant velocities.
///
/// Class by Bayes; moving if one says so, else static if one says so. The logarithms of the odds
/// add up, as for independent detectors. The points are those of the one whose position is surer,
/// as they are asked where exactly it was seen. Both must be valid (isValid).
Object combined(const Object& a, const Object& b);

/// Class and probability alone: of one that says nothing the other's, else Bayes. `result` may be
/// one of both.
void combineClass(const Object& a, const Object& b, Object& result);

}  // namespace datmo
