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

/// The processors of this machine; at least 1.
int processorCount();

/// The command line of `run_bag`, including the switches of the stack.
struct Arguments : StackSwitches {
  std::string input;                 ///< bag
  std::string output;                ///< bag
  std::string config;                ///< yaml file of a sensor set
  std::vector<std::string> presets;  ///< yaml files that override it
  bool with_truth = false;
  bool quiet = false;
  LastStage last_stage = LastStage::kEnd;
  FusionLevel fusion = FusionLevel::kNone;  ///< its switches are among those of the stack
  bool stereo_from_images = false;          ///< even if the bag has clouds
  bool write_grids = false;
  std::string grid_rule;        ///< of fusion, overrides the yaml file; empty: as in the file
  std::string map;              ///< file to start in; empty: none
  std::vector<double> start;    ///< approximate x, y (m), heading (degrees) in it; empty: anywhere
  std::string save_map;         ///< file for the map at the end; empty: none
  std::string report;           ///< JSON file for the report of the run; empty: none
  std::string times;            ///< JSON file for the stages' times; empty: none
  int jobs = processorCount();  ///< threads; from 2 on, stereo images are matched ahead
  TextFiles text;
  std::map<std::string, std::string> remappings;  ///< our topic (`scan`) -> the input's

  /// Whether object_fusion runs: by its own switch, or by that of another source of objects.
  bool fusesObjects() const;

  /// The option of a sensor whose objects are fused even without object_fusion's switch; empty:
  /// none.
  std::string fusedSource() const;

  /// The name in the input bag of one of our topics, with a leading slash.
  std::string inputTopic(const std::string& topic) const;

  /// The same for a topic whose default differs from our name for it.
  std::string inputTopic(const std::string& topic, const std::string& usual) const;
};

/// The option of a switch of the stack: --road-border for road_border.
std::string optionOf(bool StackSwitches::*value);

/// Parses the words after the program's name. Throws UsageError, and Answer for --help.
Arguments parseArguments(std::vector<std::string> words);

}  // namespace datmo
