#include "kitti_tracking/run_arguments.h"

#include <filesystem>

#include "yaml_options.h"

namespace datmo::kitti {

namespace {

constexpr std::size_t kFolders = 3;

/// The words of the command line: folders, and the values of options.
struct Words {
  std::vector<std::string> folders;
  std::string config;
  std::vector<std::string> assignments;
};

Words sorted(const std::vector<std::string>& given) {
  Words words;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string& word = given[i];
    if (word.rfind("--", 0) != 0) {
      words.folders.push_back(word);
    } else if (word != "--config" && word != "--set") {
      throw OptionError("'" + word + "': expected a folder, --config or --set");
    } else if (i + 1 == given.size()) {
      throw OptionError(word + ": expected a value behind it");
    } else if (word == "--set") {
      words.assignments.push_back(given[++i]);
    } else {
      words.config = given[++i];
    }
  }
  return words;
}

/// The values of a class's file, under the name of the class.
void readClass(const std::string& folder, const std::string& name, OptionValues& values) {
  const std::string file = (std::filesystem::path(folder) / (name + ".yaml")).string();
  for (const auto& [key, value] : optionValues(loadYaml(file))) {
    values[name + "/" + key] = value;
  }
}

}  // namespace

std::string runUsage() {
  return "usage: kitti_tracking_run DETECTIONS_DIR CALIBRATIONS_DIR RESULTS_DIR [--config DIR]"
         " [--set KEY=VALUE]\n"
         "Follows the objects that a 3D detector has found in KITTI tracking sequences with the "
         "package's tracker, and writes RESULTS_DIR/NAME.txt in KITTI's format for each "
         "CALIBRATIONS_DIR/NAME.txt. The vehicle's motion is estimated from the detections.\n"
         "  DETECTIONS_DIR     has Car/NAME.txt, Pedestrian/NAME.txt and Cyclist/NAME.txt; a "
         "missing one: none\n"
         "  --config DIR       options of each class: car.yaml, pedestrian.yaml, cyclist.yaml\n"
         "  --set KEY=VALUE    one option, e.g. --set estimate_ego_motion=false or "
         "--set car/tracker/association=gnn\n";
}

RunArguments parseRunArguments(const std::vector<std::string>& words) {
  const Words given = sorted(words);
  if (given.folders.size() != kFolders) {
    throw OptionError(std::to_string(given.folders.size()) +
                      " folders are named: expected those of the detections, the calibrations and "
                      "the results");
  }
  OptionValues values;
  if (!given.config.empty()) {
    for (const char* name : kClassNames) {
      readClass(given.config, name, values);
    }
  }
  for (const std::string& assignment : given.assignments) {
    setOption(assignment, values);
  }
  return {given.folders[0], given.folders[1], given.folders[2], readOptions<RunOptions>(values)};
}

}  // namespace datmo::kitti
