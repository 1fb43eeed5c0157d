// SPDX-License-Identifier: BSD-3-Clause
#include "settings.h"

#include "run_bag/sensor_set.h"

#include "datmo_fusion/ros/stage/grid_slam_stage.h"
#include "datmo_fusion/ros/stage/road_border_stage.h"

namespace datmo {

namespace {

Settings settingsOf(int beams, const char* file) {
  const SensorSet sensors(file);
  return {beams, sensors.options<GridSlamStageOptions>("grid_slam").slam,
          sensors.options<RoadBorderStageOptions>("road_border").detector};
}

}  // namespace

Settings demonstratorSettings() {
  return settingsOf(81, DATMO_FUSION_SOURCE_DIR "/config/demonstrator.yaml");
}

Settings heavySettings() {
  return settingsOf(641, DATMO_FUSION_SOURCE_DIR "/benchmark/heavy.yaml");
}

}  // namespace datmo
