// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/object.h"

namespace datmo {

/// Several objects, at least one, as one, in the axes of the target that they may be parts of.
Object unionOf(const std::vector<const Object*>& parts, double heading);

/// Some points of an object, at least one, as the part of it that belongs to one target, in that
/// target's axes; the other target is in the direction `other`, where the part ends without having
/// been seen to.
Object partOf(const Object& whole, std::vector<Point2> points, double heading, const Point2& other);

}  // namespace datmo
