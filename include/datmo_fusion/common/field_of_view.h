// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Field of view of a sensor that reports objects, not beams: a camera or a detector in point
/// clouds.
struct FieldOfView {
  Pose2 sensor_in_base;
  double min_bearing = -kPi;  ///< rad, about the sensor, from its x axis to the left
  double max_bearing = kPi;   ///< rad, greater than min_bearing, by at most 2 pi
  double sure_range = 0.0;    ///< m, full detection probability up to here
  double range = 0.0;         ///< m, detection probability falls to 0 from sure_range to here
};

}  // namespace datmo
