// SPDX-License-Identifier: BSD-3-Clause
#include "stage_types.h"

#include "stereo_images.h"

#include "datmo_fusion/ros/stage/cloud_objects_stage.h"
#include "datmo_fusion/ros/stage/cloud_to_scan_stage.h"
#include "datmo_fusion/ros/stage/earth_frame_stage.h"
#include "datmo_fusion/ros/stage/grid_fusion_stage.h"
#include "datmo_fusion/ros/stage/grid_slam_stage.h"
#include "datmo_fusion/ros/stage/lidar_grid_stage.h"
#include "datmo_fusion/ros/stage/loop_closing_stage.h"
#include "datmo_fusion/ros/stage/map_fusion_stage.h"
#include "datmo_fusion/ros/stage/mono_classifier_stage.h"
#include "datmo_fusion/ros/stage/mono_grid_stage.h"
#include "datmo_fusion/ros/stage/motion_stage.h"
#include "datmo_fusion/ros/stage/moving_objects_stage.h"
#include "datmo_fusion/ros/stage/object_fusion_stage.h"
#include "datmo_fusion/ros/stage/point_velocity_stage.h"
#include "datmo_fusion/ros/stage/radar_objects_stage.h"
#include "datmo_fusion/ros/stage/risk_stage.h"
#include "datmo_fusion/ros/stage/road_border_stage.h"
#include "datmo_fusion/ros/stage/scan_merge_stage.h"
#include "datmo_fusion/ros/stage/static_points_stage.h"
#include "datmo_fusion/ros/stage/stereo_alignment_stage.h"
#include "datmo_fusion/ros/stage/stereo_grid_stage.h"
#include "datmo_fusion/ros/stage/stereo_objects_stage.h"
#include "datmo_fusion/ros/stage/track_fusion_stage.h"
#include "datmo_fusion/ros/stage/tracker_stage.h"
#include "datmo_fusion/ros/stage/v2x_stage.h"

namespace datmo {

namespace {

template <typename MadeStage>
StageType typeOf() {
  using Options = typename MadeStage::Options;
  return {[](const OptionValues& values, const SharedOptions& shared) {
            readStageOptions<Options>(values, shared);
          },
          [](const OptionValues& values, const SharedOptions& shared, const StageContext& context) {
            return makeStage<MadeStage>(readStageOptions<Options>(values, shared), context);
          }};
}

}  // namespace

const std::map<std::string, StageType>& stageTypes() {
  static const std::map<std::string, StageType> types{
      {"cloud_objects", typeOf<CloudObjectsStage>()},
      {"cloud_to_scan", typeOf<CloudToScanStage>()},
      {"earth_frame", typeOf<EarthFrameStage>()},
      {"grid_fusion", typeOf<GridFusionStage>()},
      {"grid_slam", typeOf<GridSlamStage>()},
      {"lidar_grid", typeOf<LidarGridStage>()},
      {"loop_closing", typeOf<LoopClosingStage>()},
      {"map_fusion", typeOf<MapFusionStage>()},
      {"mono_classifier", typeOf<MonoClassifierStage>()},
      {"mono_grid", typeOf<MonoGridStage>()},
      {"motion", typeOf<MotionStage>()},
      {"moving_objects", typeOf<MovingObjectsStage>()},
      {"object_fusion", typeOf<ObjectFusionStage>()},
      {"point_velocity", typeOf<PointVelocityStage>()},
      {"radar_objects", typeOf<RadarObjectsStage>()},
      {"risk", typeOf<RiskStage>()},
      {"road_border", typeOf<RoadBorderStage>()},
      {"scan_merge", typeOf<ScanMergeStage>()},
      {"static_points", typeOf<StaticPointsStage>()},
      {"stereo_alignment", typeOf<StereoAlignmentStage>()},
      {"stereo_grid", typeOf<StereoGridStage>()},
      {"stereo_image_proc", typeOf<StereoImages>()},
      {"stereo_objects", typeOf<StereoObjectsStage>()},
      {"track_fusion", typeOf<TrackFusionStage>()},
      {"tracker", typeOf<TrackerStage>()},
      {"v2x", typeOf<V2xStage>()},
  };
  return types;
}

}  // namespace datmo
