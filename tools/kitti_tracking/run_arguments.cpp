// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/run_arguments.h"

#include <filesystem>
#include <utility>

#include "command_line.h"
#include "yaml_options.h"

namespace datmo::kitti {

namespace {

constexpr char kDescription[] =
    "Tracks the detections of a 3D detector in KITTI tracking sequences with the package's\n"
    "tracker, and writes RESULTS_DIR/NAME.txt in KITTI's format for each\n"
    "CALIBRATIONS_DIR/NAME.txt. The vehicle's motion is estimated from the detections.";

/// The values of a class's file, under the name of the class.
void readClass(const std::string& folder, const std::string& name, OptionValues& values) {
  const std::string file = (std::filesystem::path(folder) / (name + ".yaml")).string();
  for (const auto& [key, value] : optionValues(loadYaml(file))) {
    values[name + "/" + key] = value;
  }
}

}  // namespace

RunArguments parseRunArguments(std::vector<std::string> words) {
  RunArguments arguments;
  std::string config;
  std::vector<std::string> assignments;
  CommandLine line("kitti_tracking_run", kDescription, "folders");
  line.addFile(
          "DETECTIONS_DIR", arguments.detections,
          "Car/NAME.txt, Pedestrian/NAME.txt and Cyclist/NAME.txt; a missing file: no detections")
      ->required();
  line.addFile("CALIBRATIONS_DIR", arguments.calibrations, "NAME.txt of each sequence")->required();
  line.addFile("RESULTS_DIR", arguments.results, "created if missing")->required();
  line.addFile("--config", config, "options of each class: car.yaml, pedestrian.yaml, cyclist.yaml",
               "DIR");
  line.addRepeated("--set", assignments,
                   "one option, e.g. estimate_ego_motion=false or car/tracker/association=gnn",
                   "KEY=VALUE");
  line.read(std::move(words));
  OptionValues values;
  if (!config.empty()) {
    for (const char* name : kClassNames) {
      readClass(config, name, values);
    }
  }
  for (const std::string& assignment : assignments) {
    setOption(assignment, values);
  }
  arguments.options = readOptions<RunOptions>(values);
  return arguments;
}

}  // namespace datmo::kitti
