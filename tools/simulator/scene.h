// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "simulator/class_camera.h"
#include "simulator/collision.h"
#include "simulator/ground_truth.h"
#include "simulator/laser_scanner.h"
#include "simulator/odometer.h"
#include "simulator/stereo_camera.h"
#include "simulator/traffic.h"
#include "simulator/vehicle_sensors.h"
#include "simulator/world.h"

#include "datmo_fusion/common/options.h"

namespace datmo::simulator {

/// All settings of a run besides the scene itself.
struct SimulationOptions {
  int seed = 1;
  double duration = 20.0;  ///< s
  std::string compression = "none";
  bool contact = false;
  LaserScannerOptions scanner;
  StereoCameraOptions stereo;
  ClassCameraOptions mono;
  OdometerOptions odometer;
  VehicleSensorOptions vehicle_sensors;
  GroundTruthOptions ground_truth;
  TrafficOptions traffic;

  void visit(OptionVisitor& visitor);
};

struct Scene {
  SimulationOptions options;
  World world;
  std::optional<EgoContact> contact;  ///< if the options allow it and it happens
};

/// Reads a scene file (described in rosbag_fixtures/README.md). `overrides` replace options of its
/// section `options`, by full key.
///
/// Throws OptionError that names the file, the location in it, the value and what was expected: for
/// an unknown key, a value out of bounds, a path that is too short for its speeds, and bodies that
/// collide.
Scene readScene(const std::string& file, const OptionValues& overrides = {});

}  // namespace datmo::simulator
