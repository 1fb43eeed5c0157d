// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Derivative of a rotated vector by the angle that turns it.
inline Point2 turned(const Point2& rotated) { return {-rotated.y(), rotated.x()}; }

}  // namespace datmo
