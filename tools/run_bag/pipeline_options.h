#pragma once

#include <string>

#include "stereo_images_options.h"

#include "datmo_fusion/ros/grid_fusion_stage.h"
#include "datmo_fusion/ros/grid_slam_stage.h"
#include "datmo_fusion/ros/lidar_grid_stage.h"
#include "datmo_fusion/ros/moving_objects_stage.h"
#include "datmo_fusion/ros/stereo_grid_stage.h"
#include "datmo_fusion/ros/tracker_stage.h"

namespace datmo {

/// The options of the stages before grid_slam, which low-level fusion takes.
struct LowLevelOptions {
  StereoImagesOptions stereo_images;
  LidarGridStageOptions lidar_grid;
  StereoGridStageOptions stereo_grid;
  GridFusionStageOptions grid_fusion;
};

/// The options of all stages, as in the sections of a sensor set's yaml file.
struct PipelineOptions {
  LowLevelOptions low_level;
  GridSlamStageOptions grid_slam;
  MovingObjectsStageOptions moving_objects;
  TrackerStageOptions tracker;
};

/// Reads config/<sensor set>.yaml. Throws OptionError that names file, section and key.
PipelineOptions readPipelineOptions(const std::string& file);

}  // namespace datmo
