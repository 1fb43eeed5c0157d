// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stage_graph.h"

namespace datmo {

namespace {

/// s; a detector in images may take longer than several scanner periods.
constexpr double kMonoLateBy = 0.4;

using Remaps = std::map<std::string, std::string>;

/// A row of the graph: the condition for a stage, and the stage.
struct Row {
  bool present = false;
  StackPart part = StackPart::kPerception;
  std::string name;
  Remaps remaps = {};
  OptionValues parameters = {};
  std::string type = {};  ///< empty: same as the name
};

using Rows = std::vector<Row>;

/// Remappings for the stereo camera's clouds.
Remaps cameraRemaps() {
  return {{"points2", "stereo/points2"}, {"right/camera_info", "stereo/right/camera_info"}};
}

/// Remappings for the stereo camera's images and what is derived from them.
Remaps imageRemaps() {
  return {{"left/image", "stereo/left/image_rect"},
          {"left/camera_info", "stereo/left/camera_info"},
          {"right/image", "stereo/right/image_rect"},
          {"right/camera_info", "stereo/right/camera_info"},
          {"point_velocities", "stereo/point_velocities"},
          {"points2", "stereo/points2"}};
}

Remaps with(Remaps remaps, const std::string& topic, const std::string& graph_topic) {
  remaps[topic] = graph_topic;
  return remaps;
}

/// Sources that grid_fusion and map_fusion fuse in addition to those in their sections.
OptionValues fusedGrids(const GraphSwitches& switches) {
  return switches.mono ? OptionValues{{"sources/mono/use", true}} : OptionValues();
}

/// Sources that object_fusion fuses in addition to those in its section.
OptionValues fusedSources(const GraphSwitches& switches) {
  OptionValues sources;
  if (switches.mono) {
    sources["sources/mono/use"] = true;
    sources["sources/mono/late_by"] = kMonoLateBy;
  }
  if (switches.radar) {
    sources["sources/radar/use"] = true;
  }
  if (switches.cloud_objects) {
    sources["sources/cloud/use"] = true;
  }
  if (!switches.object_fusion) {
    sources["sources/stereo/use"] = false;
  }
  return sources;
}

/// Sources that track_fusion fuses in addition to those in its section.
OptionValues fusedTracks(const GraphSwitches& switches) {
  return switches.v2x ? OptionValues{{"sources/v2x/use", true}} : OptionValues();
}

/// The topic of the scans for SLAM.
std::string scanOf(const GraphSwitches& switches) {
  return switches.scan_from_cloud ? "cloud_scan" : switches.merge_scans ? "merged_scan" : "scan";
}

bool fusesObjects(const GraphSwitches& switches) {
  return switches.object_fusion || switches.mono || switches.radar || switches.cloud_objects;
}

Remaps monoImages() {
  return {{"image", "stereo/left/image_rect"}, {"camera_info", "stereo/left/camera_info"}};
}

/// From sensor messages to scans, points and odometry.
Rows inputRows(const GraphSwitches& switches) {
  const Remaps scan{{"scan", scanOf(switches)}};
  const bool has_images = switches.stereo != StereoPoints::kClouds;
  const OptionValues rectified{{"rectified", switches.stereo == StereoPoints::kRectifiedImages}};
  return {
      {switches.scan_from_cloud, StackPart::kSensors, "cloud_to_scan", scan},
      {true, StackPart::kSensors, "motion"},
      {switches.merge_scans, StackPart::kSensors, "scan_merge", scan},
      // Before the points of the same images, whose objects get their velocities.
      {has_images && switches.stereo_objects, StackPart::kStereo, "point_velocity", imageRemaps(),
       rectified},
      {has_images, StackPart::kStereo, "stereo_image_proc", imageRemaps(), rectified},
  };
}

/// Grids, SLAM, and what is derived from the labeled scans.
Rows mapRows(const GraphSwitches& switches) {
  const Remaps scan{{"scan", scanOf(switches)}};
  const Remaps camera = cameraRemaps();
  const bool low_level = switches.low_level_fusion;
  const bool grids = low_level || switches.map_fusion;
  return {
      // Before the stages that use the same clouds.
      {grids || switches.stereo_objects, StackPart::kStereo, "stereo_alignment",
       with(camera, "scan", scanOf(switches))},
      {grids, StackPart::kPerception, "lidar_grid", scan},
      {grids, StackPart::kStereo, "stereo_grid", camera},
      {grids && switches.mono, StackPart::kStereo, "mono_grid",
       with(monoImages(), "scan", scanOf(switches))},
      {low_level, StackPart::kPerception, "grid_fusion", {}, fusedGrids(switches)},
      {true, StackPart::kPerception, "grid_slam", scan, {{"fused_grid", low_level}}},
      {switches.map_fusion, StackPart::kPerception, "map_fusion", {}, fusedGrids(switches)},
      {switches.static_points, StackPart::kPerception, "static_points"},
      {switches.loop_closing, StackPart::kPerception, "loop_closing"},
      {switches.road_border, StackPart::kPerception, "road_border"},
  };
}

/// From labeled scans, points, clouds and images to objects.
Rows objectRows(const GraphSwitches& switches) {
  return {
      {true,
       StackPart::kPerception,
       "moving_objects",
       {},
       {{"road_borders", switches.road_border}}},
      {switches.stereo_objects, StackPart::kStereo, "stereo_objects",
       with(cameraRemaps(), "point_velocities", "stereo/point_velocities")},
      {switches.cloud_objects, StackPart::kSensors, "cloud_objects"},
      {switches.radar, StackPart::kSensors, "radar_objects"},
      {switches.mono, StackPart::kStereo, "mono_classifier", monoImages()},
      {fusesObjects(switches),
       StackPart::kPerception,
       "object_fusion",
       {{"objects/lidar", "objects"}},
       fusedSources(switches)},
  };
}

/// From objects to tracks, and what is derived from these.
Rows trackRows(const GraphSwitches& switches) {
  const std::string objects = fusesObjects(switches) ? "objects/fused" : "objects";
  const std::string tracks = switches.track_fusion ? "tracks/lidar" : "tracks";
  return {
      {true,
       StackPart::kPerception,
       "tracker",
       {{"objects", objects}, {"early_objects", "objects/early"}, {"tracks", tracks}}},
      // The scanner's field of view is not the camera's.
      {switches.stereo_tracker,
       StackPart::kPerception,
       "stereo_tracker",
       {{"objects", "objects/stereo"}, {"tracks", "tracks/stereo"}},
       {{"scan_view", false}},
       "tracker"},
      {switches.v2x, StackPart::kPerception, "earth_frame"},
      {switches.v2x, StackPart::kPerception, "v2x", {{"tracks/own", tracks}}},
      {switches.track_fusion,
       StackPart::kPerception,
       "track_fusion",
       {{"tracks/fused", "tracks"}},
       fusedTracks(switches)},
      {switches.risk, StackPart::kRisk, "risk", {}, {{"road_borders", switches.road_border}}},
  };
}

}  // namespace

GraphSwitches allSwitches() {
  GraphSwitches all;
  for (const NamedSwitch& each : stackSwitches()) {
    all.*each.value = true;
  }
  all.scan_from_cloud = all.stereo_objects = all.stereo_tracker = true;
  all.stereo = StereoPoints::kRectifiedImages;
  return all;
}

StackSwitches fusionSwitches(FusionLevel level) {
  StackSwitches switches;
  switches.low_level_fusion = level == FusionLevel::kLow;
  switches.object_fusion = level == FusionLevel::kObject;
  switches.track_fusion = level == FusionLevel::kTrack || level == FusionLevel::kRecommended;
  switches.road_border = level == FusionLevel::kRecommended;
  return switches;
}

std::string GraphStage::resolved(const std::string& topic) const {
  const auto remap = remaps.find(topic);
  return remap == remaps.end() ? topic : remap->second;
}

std::vector<GraphStage> stageGraph(const GraphSwitches& switches) {
  std::vector<GraphStage> graph;
  for (const Rows& rows :
       {inputRows(switches), mapRows(switches), objectRows(switches), trackRows(switches)}) {
    for (const Row& row : rows) {
      if (row.present) {
        graph.push_back({row.name, row.type.empty() ? row.name : row.type, row.remaps,
                         row.parameters, row.part});
      }
    }
  }
  return graph;
}

}  // namespace datmo
