// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/sensor_model/cloud_to_scan.h"

namespace datmo {

/// A cloud of a lidar with 64 rows in a street, 130,048 points: house fronts 8 m to both sides, a
/// car 12 m ahead, the road between them.
LidarCloud cloudOfStreet();

}  // namespace datmo
