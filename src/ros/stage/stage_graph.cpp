// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stage_graph.h"

#include <utility>

namespace datmo {

namespace {

/// s; a detector in images may take longer than the scanner for some turns.
constexpr double kMonoLateBy = 0.4;

using Remaps = std::map<std::string, std::string>;

StackPart partOf(const std::string& type) {
  static const std::map<std::string, StackPart> parts{{"cloud_objects", StackPart::kSensors},
                                                      {"cloud_to_scan", StackPart::kSensors},
                                                      {"motion", StackPart::kSensors},
                                                      {"scan_merge", StackPart::kSensors},
                                                      {"radar_objects", StackPart::kSensors},
                                                      {"mono_classifier", StackPart::kStereo},
                                                      {"mono_grid", StackPart::kStereo},
                                                      {"point_velocity", StackPart::kStereo},
                                                      {"stereo_alignment", StackPart::kStereo},
                                                      {"stereo_grid", StackPart::kStereo},
                                                      {"stereo_image_proc", StackPart::kStereo},
                                                      {"stereo_objects", StackPart::kStereo},
                                                      {"risk", StackPart::kRisk}};
  const auto part = parts.find(type);
  return part == parts.end() ? StackPart::kPerception : part->second;
}

/// The stereo camera's clouds.
Remaps cameraRemaps() {
  return {{"points2", "stereo/points2"}, {"right/camera_info", "stereo/right/camera_info"}};
}

/// The stereo camera's images, and what is made of them.
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

/// What grid_fusion and map_fusion fuse beside the sources that their sections name.
OptionValues fusedGrids(const GraphSwitches& switches) {
  return switches.mono ? OptionValues{{"sources/mono/use", true}} : OptionValues();
}

/// What object_fusion fuses beside the sources that its section names.
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

/// What track_fusion fuses beside the sources that its section names.
OptionValues fusedTracks(const GraphSwitches& switches) {
  return switches.v2x ? OptionValues{{"sources/v2x/use", true}} : OptionValues();
}

}  // namespace

FusionSwitches fusionSwitches(FusionLevel level) {
  FusionSwitches switches;
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
  const std::string scan = switches.scan_from_cloud ? "cloud_scan"
                           : switches.merge_scans   ? "merged_scan"
                                                    : "scan";
  const bool fuses_objects =
      switches.object_fusion || switches.mono || switches.radar || switches.cloud_objects;
  const std::string tracked_objects = fuses_objects ? "objects/fused" : "objects";
  const std::string tracks_of_tracker = switches.track_fusion ? "tracks/lidar" : "tracks";
  const Remaps camera = cameraRemaps();
  const Remaps images = imageRemaps();
  const bool has_images = switches.stereo != StereoPoints::kClouds;
  const OptionValues rectified{{"rectified", switches.stereo == StereoPoints::kRectifiedImages}};
  const Remaps mono_images{{"image", "stereo/left/image_rect"},
                           {"camera_info", "stereo/left/camera_info"}};
  std::vector<GraphStage> graph;
  const auto add = [&graph](bool present, GraphStage stage) {
    if (present) {
      stage.part = partOf(stage.type);
      graph.push_back(std::move(stage));
    }
  };
  const bool low_level = switches.low_level_fusion;
  const bool grids = low_level || switches.map_fusion;
  add(switches.scan_from_cloud, {"cloud_to_scan", "cloud_to_scan", {{"scan", scan}}, {}});
  add(true, {"motion", "motion", {}, {}});
  add(switches.merge_scans, {"scan_merge", "scan_merge", {{"scan", scan}}, {}});
  // Before the points of the same images: what they are of gets its velocity.
  add(has_images && switches.stereo_objects,
      {"point_velocity", "point_velocity", images, rectified});
  add(has_images, {"stereo_image_proc", "stereo_image_proc", images, rectified});
  // Before those that take the same clouds.
  add(grids || switches.stereo_objects,
      {"stereo_alignment", "stereo_alignment", with(camera, "scan", scan), {}});
  add(grids, {"lidar_grid", "lidar_grid", {{"scan", scan}}, {}});
  add(grids, {"stereo_grid", "stereo_grid", camera, {}});
  add(grids && switches.mono, {"mono_grid", "mono_grid", with(mono_images, "scan", scan), {}});
  add(low_level, {"grid_fusion", "grid_fusion", {}, fusedGrids(switches)});
  add(true, {"grid_slam", "grid_slam", {{"scan", scan}}, {{"fused_grid", low_level}}});
  add(switches.map_fusion, {"map_fusion", "map_fusion", {}, fusedGrids(switches)});
  add(switches.static_points, {"static_points", "static_points", {}, {}});
  add(switches.loop_closing, {"loop_closing", "loop_closing", {}, {}});
  add(switches.road_border, {"road_border", "road_border", {}, {}});
  add(true, {"moving_objects", "moving_objects", {}, {{"road_borders", switches.road_border}}});
  add(switches.stereo_objects, {"stereo_objects",
                                "stereo_objects",
                                with(camera, "point_velocities", "stereo/point_velocities"),
                                {}});
  add(switches.cloud_objects, {"cloud_objects", "cloud_objects", {}, {}});
  add(switches.radar, {"radar_objects", "radar_objects", {}, {}});
  add(switches.mono, {"mono_classifier", "mono_classifier", mono_images, {}});
  add(fuses_objects,
      {"object_fusion", "object_fusion", {{"objects/lidar", "objects"}}, fusedSources(switches)});
  add(true,
      {"tracker", "tracker", {{"objects", tracked_objects}, {"tracks", tracks_of_tracker}}, {}});
  // What the scanner saw is not what the camera could see.
  add(switches.stereo_tracker, {"stereo_tracker",
                                "tracker",
                                {{"objects", "objects/stereo"}, {"tracks", "tracks/stereo"}},
                                {{"scan_view", false}}});
  add(switches.v2x, {"earth_frame", "earth_frame", {}, {}});
  add(switches.v2x, {"v2x", "v2x", {{"tracks/own", tracks_of_tracker}}, {}});
  add(switches.track_fusion,
      {"track_fusion", "track_fusion", {{"tracks/fused", "tracks"}}, fusedTracks(switches)});
  add(switches.risk, {"risk", "risk", {}, {{"road_borders", switches.road_border}}});
  return graph;
}

}  // namespace datmo
