// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/box2.h"

namespace datmo {

/// Returns the length of the box's projection onto a line of this direction (a unit vector), m.
double extentAlong(const Box2& box, const Point2& direction);

}  // namespace datmo
