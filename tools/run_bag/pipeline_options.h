#pragma once

#include <string>

#include "datmo_fusion/ros/grid_slam_stage.h"
#include "datmo_fusion/ros/moving_objects_stage.h"
#include "datmo_fusion/ros/tracker_stage.h"

namespace datmo {

/// The options of all stages, as in the sections of a sensor set's yaml file.
struct PipelineOptions {
  GridSlamStageOptions grid_slam;
  MovingObjectsStageOptions moving_objects;
  TrackerStageOptions tracker;
};

/// Reads config/<sensor set>.yaml. Throws OptionError that names file, section and key.
PipelineOptions readPipelineOptions(const std::string& file);

}  // namespace datmo
