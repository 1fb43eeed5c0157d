// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// A vector turned to the left by a right angle; of a rotated vector the derivative by the angle.
inline Point2 perpendicular(const Point2& vector) { return {-vector.y(), vector.x()}; }

}  // namespace datmo
