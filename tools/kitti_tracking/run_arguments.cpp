#include "kitti_tracking/run_arguments.h"

#include "yaml_options.h"

namespace datmo::kitti {

namespace {

bool isClass(const std::string& name) {
  return name == "car" || name == "pedestrian" || name == "cyclist";
}

/// The values of a class's file, under the name of the class.
void readClass(const std::string& name, const std::string& file, OptionValues& values) {
  try {
    for (const auto& [key, value] : optionValues(loadYaml(file))) {
      values[name + "/" + key] = value;
    }
  } catch (const OptionError& error) {
    throw OptionError(file + ": " + error.what());
  }
}

}  // namespace

std::string runUsage() {
  return "usage: kitti_tracking_run DETECTIONS_DIR CALIBRATIONS_DIR RESULTS_DIR [--CLASS CONFIG]"
         " [--set KEY=VALUE]\n"
         "Follows the objects that a 3D detector has found in KITTI tracking sequences with the "
         "package's tracker, and writes RESULTS_DIR/NAME.txt in KITTI's format for each "
         "CALIBRATIONS_DIR/NAME.txt.\n"
         "  DETECTIONS_DIR       Car/NAME.txt, Pedestrian/NAME.txt and Cyclist/NAME.txt; a missing "
         "one: none\n"
         "  --CLASS CONFIG       options of --car, --pedestrian or --cyclist: config/"
         "kitti_tracking_CLASS.yaml\n"
         "  --set KEY=VALUE      one option, e.g. --set estimate_ego_motion=false or "
         "--set car/tracker/association=gnn\n"
         "The vehicle's motion is estimated from the detections themselves.\n";
}

RunArguments parseRunArguments(const std::vector<std::string>& words) {
  RunArguments arguments;
  std::vector<std::string> folders;
  OptionValues values;
  std::vector<std::string> assignments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word.rfind("--", 0) != 0) {
      folders.push_back(word);
      continue;
    }
    const std::string option = word.substr(2);
    if (option != "set" && !isClass(option)) {
      throw OptionError("'" + word +
                        "': expected a folder, --car, --pedestrian, --cyclist or --set");
    }
    if (i + 1 == words.size()) {
      throw OptionError(word + ": expected a value behind it");
    }
    ++i;
    if (option == "set") {
      assignments.push_back(words[i]);
    } else {
      readClass(option, words[i], values);
    }
  }
  if (folders.size() != 3) {
    throw OptionError(std::to_string(folders.size()) +
                      " folders are named: expected those of the detections, the calibrations and "
                      "the results");
  }
  for (const std::string& assignment : assignments) {
    setOption(assignment, values);
  }
  arguments.detections = folders[0];
  arguments.calibrations = folders[1];
  arguments.results = folders[2];
  arguments.options = readOptions<RunOptions>(values);
  return arguments;
}

}  // namespace datmo::kitti
