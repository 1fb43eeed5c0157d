// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "command_line.h"
#include "last_stage.h"
#include "text_files.h"

#include "datmo_fusion/ros/stage/stage_graph.h"

namespace datmo {

/// What `run_bag` is asked to do; the switches of the stack are among it.
struct Arguments : StackSwitches {
  std::string input;                 ///< bag
  std::string output;                ///< bag
  std::string config;                ///< yaml file of a sensor set
  std::vector<std::string> presets;  ///< yaml files that are laid over it
  bool with_truth = false;
  bool quiet = false;
  LastStage last_stage = LastStage::kEnd;
  FusionLevel fusion = FusionLevel::kNone;  ///< its switches are among those of the stack
  bool stereo_from_images = false;          ///< also where the bag has clouds
  bool write_grids = false;
  std::string grid_rule;      ///< of fusion, in place of the yaml file's; empty: that one
  std::string map;            ///< file to start in; empty: none
  std::vector<double> start;  ///< x, y (m), heading (degrees) in it, about; empty: anywhere
  std::string save_map;       ///< file for the map at the end; empty: none
  std::string report;         ///< JSON file for what became of the bag; empty: none
  std::string times;          ///< JSON file for the stages' times; empty: none
  TextFiles text;
  std::map<std::string, std::string> remappings;  ///< our topic (`scan`) -> the input's

  /// Whether object_fusion runs: by its switch, or by that of another sensor of objects.
  bool fusesObjects() const;

  /// The option of a sensor whose objects are fused without object_fusion's switch; empty: none.
  std::string fusedSource() const;

  /// The name of one of our topics in the input bag, with a leading slash.
  std::string inputTopic(const std::string& topic) const;

  /// The same for a topic that has another default than our name for it.
  std::string inputTopic(const std::string& topic, const std::string& usual) const;
};

/// The type of the stage; empty for kEnd.
std::string stageType(LastStage stage);

/// Reads the words behind the program's name. Throws UsageError, and Answer for --help.
Arguments parseArguments(std::vector<std::string> words);

}  // namespace datmo
