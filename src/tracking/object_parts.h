// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/object.h"

namespace datmo {

/// Merges several objects, at least one, along the axes of the target that they may be parts of.
Object unionOf(const std::vector<const Object*>& parts, double heading);

/// Returns some points of an object, at least one, as the part of it that belongs to one target,
/// along that target's axes; the other target is in the direction `other`, where the end of the
/// part is hidden.
Object partOf(const Object& whole, std::vector<Point2> points, double heading, const Point2& other);

}  // namespace datmo
