// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/risk/host_motion.h"
#include "datmo_fusion/sensor_model/own_vehicle.h"

namespace datmo {

/// The host vehicle, for all stages: section `vehicle` of a sensor set.
struct VehicleOptions {
  HostVehicleOptions body;
  double height = 1.5;  ///< m
  OwnVehicleOptions own_points;

  void visit(OptionVisitor& visitor);
};

}  // namespace datmo
