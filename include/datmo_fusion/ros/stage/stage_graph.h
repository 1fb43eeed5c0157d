// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// Source of the stereo camera's points.
enum class StereoPoints { kClouds, kRectifiedImages, kRawImages };

/// The switches for users.
struct StackSwitches {
  bool low_level_fusion = false;
  bool map_fusion = false;  ///< each sensor builds its own map, and the maps are fused
  bool road_border = false;
  bool merge_scans = false;    ///< the scans are merged from several scanners
  bool cloud_objects = false;  ///< objects are detected in a 3D lidar's clouds
  bool radar = false;          ///< objects are detected by a radar, and fused
  bool mono = false;           ///< a camera's images classify the scanner's objects
  bool static_points = false;  ///< static points are published for a navigation stack
  bool loop_closing = false;   ///< the trajectory is optimized in addition to live SLAM
  bool object_fusion = false;
  bool track_fusion = false;
  bool v2x = false;   ///< tracks are exchanged with other stations
  bool risk = false;  ///< risk of contact between the host and tracks or static obstacles
};

/// A switch by its name in perception.launch, `road_border`; the option of run_bag has hyphens
/// instead, --road-border.
struct NamedSwitch {
  std::string name;
  bool StackSwitches::*value;
  std::string help;  ///< help text of the option: what it does, and which topics it adds
};

/// All of them, in the order of run_bag's --help.
const std::vector<NamedSwitch>& stackSwitches();

/// The switches, and those that depend on the input.
struct GraphSwitches : StackSwitches {
  bool scan_from_cloud = false;  ///< the scans are made from a 3D lidar's clouds
  StereoPoints stereo = StereoPoints::kClouds;
  bool stereo_objects = false;  ///< objects are detected in the stereo camera's points
  bool stereo_tracker = false;  ///< the stereo camera's objects are tracked separately
};

/// Everything switched on: the graph contains every stage.
GraphSwitches allSwitches();

/// The level at which scanner and stereo camera are fused, as one switch.
enum class FusionLevel {
  kNone,
  kLow,
  kObject,
  kTrack,
  kRecommended,  ///< recommended by the results in doc/fusion.md
};

/// Returns the switches that a level turns on in addition to the user's.
StackSwitches fusionSwitches(FusionLevel level);

/// The parts of the stack that may run on machines of their own (perception.launch): each is close
/// to its data, so that little has to be transmitted between machines.
enum class StackPart {
  kSensors,     ///< processes scanners and motion sensors
  kStereo,      ///< processes images and point clouds of cameras
  kPerception,  ///< everything else: SLAM, detection, tracking, fusion
  kRisk,        ///< processes the others' results
};

/// One stage of the graph.
struct GraphStage {
  std::string name;  ///< of the node and its section in a sensor set's yaml file
  std::string type;  ///< of the nodelet; several stages may share one
  std::map<std::string, std::string> remaps;  ///< the stage's topic -> the graph's
  OptionValues parameters;                    ///< set by the switches, override the section's
  StackPart part = StackPart::kPerception;

  /// Returns the graph's name of one of the stage's topics.
  std::string resolved(const std::string& topic) const;
};

/// Returns the stages and their connections, each before those that it feeds. perception.launch
/// starts the same; a test checks that both agree.
///
/// A stage's topics are its own names for them (Stage::connect); two stages are connected if the
/// resolved names are equal. doc/development.md describes how to add a stage.
std::vector<GraphStage> stageGraph(const GraphSwitches& switches);

}  // namespace datmo
