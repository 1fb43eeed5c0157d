// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/vision/point_velocity.h"

namespace datmo {

struct ObjectVelocityOptions {
  double margin = 0.2;      ///< m
  double min_height = 0.2;  ///< m
  double max_height = 4.0;  ///< m
  SharedVelocityOptions shared;

  void visit(OptionVisitor& visitor);
};

/// Sets each object's velocity to that shared by the points in its box (sharedVelocity); none
/// without points. A point belongs to the object with the nearest box, if it is within `margin`
/// plus the standard deviation of the object's position, and at the height of road users above the
/// ground; if it is within several boxes, to the one with the nearest center. Objects and points in
/// the vehicle's frame, z up from the ground, of one time. Throws OptionError.
void measureVelocities(const std::vector<PointVelocity>& points,
                       const Checked<ObjectVelocityOptions>& options, std::vector<Object>& objects);

}  // namespace datmo
