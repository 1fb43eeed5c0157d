// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/road/road_model.h"

namespace datmo {

/// Where a point lies beside a border.
struct BorderOffset {
  double outward = 0.0;  ///< m, from the border away from the road; negative: on the road
  double sigma = 0.0;    ///< m, of the border across itself there
  Point2 direction = Point2::UnitX();  ///< of the border there, of length 1
};

/// Of a point in the border's frame, from the nearest leg that it lies beside; none if it lies
/// beside no leg (before the border's begin, behind its end).
std::optional<BorderOffset> offsetFrom(const RoadBorder& border, const Point2& point);

}  // namespace datmo
