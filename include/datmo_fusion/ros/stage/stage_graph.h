// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// What the stereo camera's points come from.
enum class StereoPoints { kClouds, kRectifiedImages, kRawImages };

/// What a user switches on and off.
struct StackSwitches {
  bool low_level_fusion = false;
  bool map_fusion = false;  ///< each sensor keeps a map of its own, and these are fused
  bool road_border = false;
  bool merge_scans = false;    ///< the scans are made of those of several scanners
  bool cloud_objects = false;  ///< objects are found in a 3D lidar's clouds
  bool radar = false;          ///< objects are found in a radar's detections, and fused
  bool mono = false;           ///< a camera's images name the scanner's objects
  bool static_points = false;  ///< what stands still comes out, for a navigation stack
  bool loop_closing = false;   ///< the drive is optimized behind the live SLAM
  bool object_fusion = false;
  bool track_fusion = false;
  bool v2x = false;   ///< tracks of other stations come in, and ours go out
  bool risk = false;  ///< of contact between the host and tracks or what stands
};

/// A switch by its name in perception.launch, `road_border`; the option of run_bag is the same with
/// hyphens, --road-border.
struct NamedSwitch {
  std::string name;
  bool StackSwitches::*value;
  std::string help;  ///< of the option: what it does, and which topics it adds
};

/// All of them, in the order of run_bag's --help.
const std::vector<NamedSwitch>& stackSwitches();

/// The switches, and what depends on the input.
struct GraphSwitches : StackSwitches {
  bool scan_from_cloud = false;  ///< the scans are made of a 3D lidar's clouds
  StereoPoints stereo = StereoPoints::kClouds;
  bool stereo_objects = false;  ///< objects are found in the stereo camera's points
  bool stereo_tracker = false;  ///< the stereo camera's objects are tracked by themselves
};

/// With all that may be switched on: each stage that there is is in its graph.
GraphSwitches allSwitches();

/// At which level scanner and stereo camera are fused, as one switch.
enum class FusionLevel {
  kNone,
  kLow,
  kObject,
  kTrack,
  kRecommended,  ///< what the figures of doc/fusion.md recommend
};

/// The switches that a level turns on, for what a user does not turn on alone.
StackSwitches fusionSwitches(FusionLevel level);

/// The parts of the stack that may run on machines of their own (perception.launch): each has what
/// is near to its data, so that little has to cross from one machine to another.
enum class StackPart {
  kSensors,     ///< takes what scanners and the motion's sensors send
  kStereo,      ///< takes images and points of cameras
  kPerception,  ///< all else: SLAM, detection, tracking, fusion
  kRisk,        ///< takes what the others have made
};

/// One stage of the graph.
struct GraphStage {
  std::string name;  ///< of the node, and of its section in a sensor set's yaml file
  std::string type;  ///< of the nodelet: several stages may have one
  std::map<std::string, std::string> remaps;  ///< the stage's topic -> the graph's
  OptionValues parameters;                    ///< that the switches set, over the section's
  StackPart part = StackPart::kPerception;

  /// The graph's name of one of the stage's topics.
  std::string resolved(const std::string& topic) const;
};

/// The stages and what connects them, each before those that it feeds. perception.launch starts the
/// same; a test holds the two together.
///
/// A stage's topics are its own names for them (Stage::connect); two stages are connected where
/// the resolved names are equal. doc/development.md says what a new stage takes.
std::vector<GraphStage> stageGraph(const GraphSwitches& switches);

}  // namespace datmo
