#pragma once

#include <string>

#include "stereo_images_options.h"

#include "datmo_fusion/ros/cloud_to_scan_stage.h"
#include "datmo_fusion/ros/grid_fusion_stage.h"
#include "datmo_fusion/ros/grid_slam_stage.h"
#include "datmo_fusion/ros/lidar_grid_stage.h"
#include "datmo_fusion/ros/moving_objects_stage.h"
#include "datmo_fusion/ros/object_fusion_stage.h"
#include "datmo_fusion/ros/road_border_stage.h"
#include "datmo_fusion/ros/stereo_grid_stage.h"
#include "datmo_fusion/ros/stereo_objects_stage.h"
#include "datmo_fusion/ros/track_fusion_stage.h"
#include "datmo_fusion/ros/tracker_stage.h"

namespace datmo {

/// The options of the stages before grid_slam, which low-level fusion takes.
struct LowLevelOptions {
  LidarGridStageOptions lidar_grid;
  StereoGridStageOptions stereo_grid;
  GridFusionStageOptions grid_fusion;
};

/// The options of the stages after tracker, which track-level fusion takes.
struct TrackFusionOptions {
  TrackerStageOptions stereo_tracker;
  TrackFusionStageOptions track_fusion;
};

/// The options of all stages, as in the sections of a sensor set's yaml file.
struct PipelineOptions {
  CloudToScanStageOptions cloud_to_scan;
  StereoImagesOptions stereo_images;
  LowLevelOptions low_level;
  GridSlamStageOptions grid_slam;
  RoadBorderStageOptions road_border;
  MovingObjectsStageOptions moving_objects;
  StereoObjectsStageOptions stereo_objects;
  ObjectFusionStageOptions object_fusion;
  TrackerStageOptions tracker;
  TrackFusionOptions track_level;
  SharedOptions shared;  ///< as all stages above have it
};

/// Reads config/<sensor set>.yaml. Throws OptionError that names file, section and key.
PipelineOptions readPipelineOptions(const std::string& file);

}  // namespace datmo
