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

/// Gives each object the velocity that the points in its box share (sharedVelocity); none where no
/// point is. A point belongs to the object whose box is nearest, if it is within `margin` and the
/// standard deviation of the object's position of it, and as high above the ground as road users
/// are; within several boxes, to that of the nearest center. Objects and points in the vehicle's
/// frame, z up from the ground, of one time. Throws OptionError.
void measureVelocities(const std::vector<PointVelocity>& points,
                       const Checked<ObjectVelocityOptions>& options, std::vector<Object>& objects);

}  // namespace datmo
