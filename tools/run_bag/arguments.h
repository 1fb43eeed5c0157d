#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "last_stage.h"
#include "text_files.h"

namespace datmo {

/// The command line cannot be understood; the message says what and how it should be.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What `run_bag` is asked to do.
struct Arguments {
  std::string input;   ///< bag
  std::string output;  ///< bag
  std::string config;  ///< yaml file of a sensor set
  bool with_truth = false;
  bool quiet = false;
  LastStage last_stage = LastStage::kEnd;
  bool low_level_fusion = false;
  bool road_border = false;
  bool static_points = false;
  bool cloud_objects = false;
  bool object_fusion = false;
  bool track_fusion = false;
  bool stereo_from_images = false;  ///< also where the bag has clouds
  bool write_grids = false;
  std::string grid_rule;  ///< of fusion, in place of the yaml file's; empty: that one
  std::string times;      ///< JSON file for the stages' times; empty: none
  TextFiles text;
  std::map<std::string, std::string> remappings;  ///< our topic (`scan`) -> the input's

  /// The name of one of our topics in the input bag, with a leading slash.
  std::string inputTopic(const std::string& topic) const;

  /// The same for a topic that has another default than our name for it.
  std::string inputTopic(const std::string& topic, const std::string& usual) const;
};

/// The type of the stage; empty for kEnd.
std::string stageType(LastStage stage);

/// How `run_bag` is called.
std::string usage();

/// Throws UsageError.
Arguments parseArguments(const std::vector<std::string>& words);

}  // namespace datmo
