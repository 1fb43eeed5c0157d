// SPDX-License-Identifier: BSD-3-Clause
#include "parameter_tables.h"

#include "datmo_fusion/common/option_table.h"
#include "datmo_fusion/ros/display/camera_view_options.h"
#include "datmo_fusion/ros/display/grid_views_options.h"
#include "datmo_fusion/ros/display/markers.h"
#include "datmo_fusion/ros/shared_options.h"
#include "datmo_fusion/ros/stage/cloud_objects_stage.h"
#include "datmo_fusion/ros/stage/cloud_to_scan_stage.h"
#include "datmo_fusion/ros/stage/grid_fusion_stage.h"
#include "datmo_fusion/ros/stage/grid_slam_stage.h"
#include "datmo_fusion/ros/stage/lidar_grid_stage.h"
#include "datmo_fusion/ros/stage/moving_objects_stage.h"
#include "datmo_fusion/ros/stage/object_fusion_stage.h"
#include "datmo_fusion/ros/stage/road_border_stage.h"
#include "datmo_fusion/ros/stage/static_points_stage.h"
#include "datmo_fusion/ros/stage/stereo_grid_stage.h"
#include "datmo_fusion/ros/stage/stereo_objects_stage.h"
#include "datmo_fusion/ros/stage/track_fusion_stage.h"
#include "datmo_fusion/ros/stage/tracker_stage.h"

namespace datmo {

namespace {

template <typename Options>
std::string section(const std::string& nodelets) {
  return "## " + nodelets + "\n\n" + optionTable<Options>();
}

constexpr const char* kHead =
    "# Parameters\n\n"
    "<!-- Made by list_parameters; do not edit. -->\n\n"
    "Keys of the sections of `config/*.yaml`, one section a nodelet. Live they are the nodelet's "
    "private\n"
    "parameters (`/grid_slam/map/cell_size`). What a sensor set does not name has the default. A "
    "misspelled key,\n"
    "or a value out of range, is refused with a message that names it.\n\n";

}  // namespace

std::string parameterTables() {
  return kHead + section<FrameOptions>("`frames`, of all nodelets") + "\n" +
         section<MountOptions>("`mounts/<frame>`, of all nodelets, for each sensor without tf") +
         "\n" + section<MotionOptions>("`motion`, of all nodelets") + "\n" +
         section<CloudToScanStageOptions>("`cloud_to_scan`") + "\n" +
         section<LidarGridStageOptions>("`lidar_grid`") + "\n" +
         section<StereoGridStageOptions>("`stereo_grid`") + "\n" +
         section<GridFusionStageOptions>("`grid_fusion`") + "\n" +
         section<GridSlamStageOptions>("`grid_slam`") + "\n" +
         section<RoadBorderStageOptions>("`road_border`") + "\n" +
         section<MovingObjectsStageOptions>("`moving_objects`") + "\n" +
         section<StaticPointsStageOptions>("`static_points`") + "\n" +
         section<StereoObjectsStageOptions>("`stereo_objects`") + "\n" +
         section<CloudObjectsStageOptions>("`cloud_objects`") + "\n" +
         section<ObjectFusionStageOptions>("`object_fusion`") + "\n" +
         section<TrackerStageOptions>("`tracker`, `stereo_tracker`") + "\n" +
         section<TrackFusionStageOptions>("`track_fusion`") + "\n" +
         section<MarkersOptions>("`markers`, `lidar_markers`, `stereo_markers`") + "\n" +
         section<GridViewsOptions>("`grid_views`") + "\n" +
         section<CameraViewOptions>("`camera_view`");
}

}  // namespace datmo
