// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/road/road_border_detector.h"
#include "datmo_fusion/slam/grid_slam.h"

namespace datmo {

/// The settings for which processing times are published.
struct Settings {
  int beams;
  GridSlamOptions slam;
  RoadBorderDetectorOptions road_border;
};

/// The demonstrator (thesis 1.3.3, 3.3.1): a beam every 2 degrees over 160 degrees, with
/// config/demonstrator.yaml. Throws OptionError, as does heavySettings.
Settings demonstratorSettings();

/// A beam every 0.25 degrees over 160 degrees, with benchmark/heavy.yaml.
Settings heavySettings();

}  // namespace datmo
