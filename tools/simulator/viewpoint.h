// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/common/pose2.h"

namespace datmo::simulator {

/// Mount and field of view of a sensor, from which the ground truth determines which objects it can
/// see.
struct Viewpoint {
  std::string sensor;          ///< name, as in visible_to
  Pose2 sensor_in_base;        ///< m, rad
  double height = 0.0;         ///< m above the road
  double field_of_view = 0.0;  ///< rad, about the sensor's x axis
  double range = 0.0;          ///< m
};

}  // namespace datmo::simulator
