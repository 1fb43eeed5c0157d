// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/sensor_model/cloud_to_scan.h"

namespace datmo {

/// The cloud of a lidar with 64 rows in a street, 130,048 points: facades at 8 m on both sides, a
/// car 12 m ahead, the road in between.
LidarCloud cloudOfStreet();

}  // namespace datmo
