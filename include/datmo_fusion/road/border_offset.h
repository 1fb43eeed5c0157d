// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/road/road_model.h"

namespace datmo {

/// Position of a point relative to a border.
struct BorderOffset {
  double outward = 0.0;  ///< m, from the border away from the road; negative: on the road side
  double sigma = 0.0;    ///< m, of the border's lateral position there
  Point2 direction = Point2::UnitX();  ///< unit vector along the border there
};

/// Returns the offset of a point in the border's frame from the nearest segment that it lies
/// beside; none if it lies beside no segment (before the border's start, behind its end).
std::optional<BorderOffset> offsetFrom(const RoadBorder& border, const Point2& point);

}  // namespace datmo
