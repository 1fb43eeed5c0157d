// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/box2.h"

namespace datmo {

/// Length of the box's shadow on a line of this direction (a unit vector), m.
double extentAlong(const Box2& box, const Point2& direction);

}  // namespace datmo
