// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "datmo_fusion/detection/box_fit.h"
#include "datmo_fusion/detection/segment_end.h"

namespace datmo {

/// What a sensor knows about the sides of a box that was fitted to its points.
struct SideModel {
  /// m^2, variance of the position of a side with this many points on it.
  std::function<double(std::size_t points)> seen_variance;

  /// The end of a visible side, along an outward unit vector whose direction is known to
  /// `heading_std` (rad); none if the end is hidden.
  std::function<std::optional<SurfaceEnd>(const Point2& normal, double heading_std)> end_beyond;
};

/// Sets the object's box, extended to the ends of the visible sides, the variance of each side, and
/// the heading, along the longer side, in (-pi/2, pi/2].
void setSides(Object& object, const BoxFit& fit, const SideModel& model);

}  // namespace datmo
