// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "simulator/laser_scanner.h"
#include "simulator/viewpoint.h"
#include "simulator/world.h"

#include "datmo_fusion/common/options.h"

namespace datmo::simulator {

struct GroundTruthOptions {
  double radius = 60.0;            ///< m
  double min_visible_share = 0.5;  ///< 0 to 1
  bool echoes = false;

  void visit(OptionVisitor& visitor);
};

/// Ground truth of an object at the time of a scan.
struct ObjectTruth {
  ObjectState state;
  std::vector<std::string> visible_to;  ///< names of sensors
  int lidar_beams = 0;                  ///< whose nearest echo is from it
  double occlusion = 0.0;               ///< 0 to 1, hidden share of its width seen from the scanner
};

/// Visibility of an object for a sensor.
struct LineOfSight {
  double hidden = 0.0;   ///< 0 to 1, share of the object's width behind other bodies
  double visible = 0.0;  ///< 0 to 1, share not hidden, in the field of view and in range
};

/// Computes the visibility of an object of the state from the sensor's position and height.
LineOfSight lookAt(const ObjectState& object, const Viewpoint& view, const World& world,
                   const WorldState& state);

/// The objects around the ego vehicle. `scan` is the scanner's at the state's time; `views` are
/// those of all sensors, the scanner first.
std::vector<ObjectTruth> objectTruths(const World& world, const WorldState& state,
                                      const EchoScan& scan, const std::vector<Viewpoint>& views,
                                      const GroundTruthOptions& options);

}  // namespace datmo::simulator
