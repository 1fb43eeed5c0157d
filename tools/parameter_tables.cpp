// SPDX-License-Identifier: BSD-3-Clause
#include "parameter_tables.h"

#include <set>
#include <vector>

#include "datmo_fusion/common/option_table.h"
#include "datmo_fusion/ros/device_options.h"
#include "datmo_fusion/ros/display/camera_view_options.h"
#include "datmo_fusion/ros/display/grid_views_options.h"
#include "datmo_fusion/ros/display/markers.h"
#include "datmo_fusion/ros/scanner_options.h"
#include "datmo_fusion/ros/shared_options.h"
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
#include "datmo_fusion/ros/stage/moving_objects_stage.h"
#include "datmo_fusion/ros/stage/object_fusion_stage.h"
#include "datmo_fusion/ros/stage/part_clocks.h"
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
#include "datmo_fusion/ros/station_wire.h"
#include "datmo_fusion/ros/stereo_camera_options.h"
#include "datmo_fusion/ros/vehicle_options.h"

namespace datmo {

namespace {

/// The options of a section of the sensor sets.
struct Section {
  std::string nodelets;
  std::string public_table;
  std::string expert_table;
};

/// What the sections of all nodelets say is listed there alone.
template <typename Options>
Section section(const std::string& nodelets) {
  std::set<std::string> shared;
  for (const SharedKey& key : sharedKeysOf<Options>()) {
    shared.insert(key.own);
  }
  return {nodelets, publicOptionTable<Options>(shared), expertOptionTable<Options>(shared)};
}

constexpr const char* kHead =
    "# Parameters\n\n"
    "<!-- Made by list_parameters; do not edit. -->\n\n"
    "Keys of the sections of `config/*.yaml`, one section a nodelet. Live they are the nodelet's "
    "private\n"
    "parameters (`/grid_slam/map/cell_size`). What a sensor set does not name has the default. A "
    "misspelled key,\n"
    "or a value out of range, is refused with a message that names it.\n\n"
    "*Public* ones depend on sensor, vehicle or city; those that say *live* may be changed while "
    "the nodelet runs\n"
    "(`rosrun rqt_reconfigure rqt_reconfigure`). *Expert* ones, below, belong to the method: their "
    "defaults have a\n"
    "source, and are changed with its papers at hand.\n\n";

constexpr const char* kPublicHead = "# Public parameters\n\n";
constexpr const char* kExpertHead = "# Expert parameters\n\n";

std::vector<Section> sections() {
  return {section<FrameOptions>("`frames`, of all nodelets"),
          section<MountOptions>("`mounts/<frame>`, of all nodelets, for each sensor without tf"),
          section<MotionOptions>("`motion`, of all nodelets"),
          section<ScannerOptions>("`scanner`, of all nodelets"),
          section<StereoSceneOptions>("`stereo_camera`, of all nodelets"),
          section<VehicleOptions>("`vehicle`, of all nodelets"),
          section<CloudToScanStageOptions>("`cloud_to_scan`"),
          section<ScanMergeStageOptions>("`scan_merge`"),
          section<LidarGridStageOptions>("`lidar_grid`"),
          section<StereoAlignmentStageOptions>("`stereo_alignment`"),
          section<StereoGridStageOptions>("`stereo_grid`"),
          section<MonoGridStageOptions>("`mono_grid`"),
          section<GridFusionStageOptions>("`grid_fusion`"),
          section<GridSlamStageOptions>("`grid_slam`"),
          section<MapFusionStageOptions>("`map_fusion`"),
          section<RoadBorderStageOptions>("`road_border`"),
          section<MovingObjectsStageOptions>("`moving_objects`"),
          section<LoopClosingStageOptions>("`loop_closing`"),
          section<StaticPointsStageOptions>("`static_points`"),
          section<PointVelocityStageOptions>("`point_velocity`"),
          section<StereoObjectsStageOptions>("`stereo_objects`"),
          section<CloudObjectsStageOptions>("`cloud_objects`"),
          section<RadarObjectsStageOptions>("`radar_objects`"),
          section<MonoClassifierStageOptions>("`mono_classifier`"),
          section<ObjectFusionStageOptions>("`object_fusion`"),
          section<TrackerStageOptions>("`tracker`, `stereo_tracker`"),
          section<TrackFusionStageOptions>("`track_fusion`"),
          section<EarthFrameStageOptions>("`earth_frame`"),
          section<V2xStageOptions>("`v2x`"),
          section<RiskStageOptions>("`risk`"),
          section<MarkersOptions>("`markers`, `lidar_markers`, `stereo_markers`"),
          section<GridViewsOptions>("`grid_views`"),
          section<CameraViewOptions>("`camera_view`"),
          section<DeviceOptions>("`device`"),
          section<StationWireOptions>("`v2x_wire`"),
          section<PartClocksOptions>("`stack`")};
}

/// The sections that have such options.
std::string part(std::string Section::*table) {
  std::string page;
  for (const Section& section : sections()) {
    if (!(section.*table).empty()) {
      page += "## " + section.nodelets + "\n\n" + section.*table + "\n";
    }
  }
  return page;
}

}  // namespace

std::string parameterTables() {
  std::string page = kHead;
  page += kPublicHead + part(&Section::public_table);
  page += kExpertHead + part(&Section::expert_table);
  page.pop_back();  // the empty line after the last table
  return page;
}

}  // namespace datmo
