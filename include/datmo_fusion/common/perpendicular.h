// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Returns the vector turned left by 90 degrees: the derivative of a rotated vector by angle.
inline Point2 perpendicular(const Point2& vector) { return {-vector.y(), vector.x()}; }

}  // namespace datmo
