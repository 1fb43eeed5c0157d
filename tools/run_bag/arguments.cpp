// SPDX-License-Identifier: BSD-3-Clause
#include "arguments.h"

#include <algorithm>
#include <thread>

#include "argument_checks.h"

#include "datmo_fusion/ros/map_files.h"

namespace datmo {

namespace {

const std::vector<std::string> kInputTopics = {
    "scan",
    "cloud",
    "object_cloud",
    "echoes",
    "odometry",
    "imu",
    "twist",
    "points2",
    "point_velocities",
    "left_image",
    "twist_with_covariance",
    "joint_states",
    "right_image",
    "left_camera_info",
    "right_camera_info",
    "radar",
    "gnss",
    "stations",
    "front_scan",
    "rear_scan",
    "steering",
    "acceleration",
};

const Choices<FusionLevel> kFusionLevels = {{"none", FusionLevel::kNone},
                                            {"low", FusionLevel::kLow},
                                            {"object", FusionLevel::kObject},
                                            {"track", FusionLevel::kTrack},
                                            {"recommended", FusionLevel::kRecommended}};

/// Where the list of stages in the help is wrapped.
constexpr std::size_t kMaxHelpLine = 70;

constexpr char kDescription[] =
    "Runs the stack on the scans and the odometry of a bag, as fast as possible, and writes\n"
    "/pose, /map, /labeled_scan, /objects, /tracks and /tf to another bag.";

constexpr char kFooter[] =
    "A topic with another name in the bag is given as TOPIC:=TOPIC_OF_THE_BAG, where TOPIC is\n"
    "scan, cloud (of a 3D lidar, instead of scans), object_cloud (for --cloud-objects, with\n"
    "scans), echoes, odometry, imu, twist, twist_with_covariance, joint_states, points2,\n"
    "point_velocities, left_image, right_image, left_camera_info, right_camera_info, radar, gnss,\n"
    "stations, front_scan, rear_scan, steering or acceleration.\n"
    "Exit code: 0 on success; 1 for an invalid command line, yaml file or bag, a missing topic,\n"
    "and when interrupted; 2 when all messages on a topic were rejected, no scan could be used or\n"
    "no tracks were published. After 1 and 2 no output bag is left.";

/// Switches that are on by default stay on.
void switchOn(FusionLevel level, Arguments& arguments) {
  const StackSwitches of_level = fusionSwitches(level);
  for (const NamedSwitch& each : stackSwitches()) {
    arguments.*each.value |= of_level.*each.value;
  }
}

Choices<LastStage> stageChoices() {
  Choices<LastStage> choices;
  for (const NamedLastStage& each : lastStages()) {
    choices.emplace_back(each.name, each.stage);
  }
  return choices;
}

/// All stages that --until accepts, in lines of at most kMaxHelpLine characters.
std::string untilHelp() {
  std::string help = "stops after";
  std::size_t line = help.size();
  for (std::size_t i = 0; i < lastStages().size(); ++i) {
    const std::size_t after = lastStages().size() - 1 - i;
    const char* const separator = after > 1 ? "," : after == 1 ? " or" : "";
    const std::string name = std::string(lastStages()[i].name) + separator;
    const bool fits = line + 1 + name.size() <= kMaxHelpLine;
    help += (fits ? " " : "\n") + name;
    line = fits ? line + 1 + name.size() : name.size();
  }
  return help;
}

void addFiles(CommandLine& line, Arguments& arguments) {
  line.addFile("IN.bag", arguments.input, "the bag with scans and odometry")->required();
  line.addFile("OUT.bag", arguments.output, "the bag for the outputs of the stages")->required();
  line.addFile("--config", arguments.config,
               "the sensor set, e.g. config/demonstrator.yaml; required", "CONFIG.yaml")
      ->required();
  line.addRepeated("--preset", arguments.presets,
                   "overrides the sensor set, e.g. config/thesis.yaml", "PRESET.yaml");
  line.addFile("--times", arguments.times, "processing time per message of each stage",
               "FILE.json");
  line.addFile("--report", arguments.report,
               "what was processed, dropped and silent, when the pose was uncertain, and which\n"
               "loops were closed",
               "FILE.json");
  line.addFile("--tum", arguments.text.tum,
               "the vehicle's poses in the format of the TUM benchmark, base_link in map",
               "POSES.txt");
  line.addFile("--kitti", arguments.text.kitti,
               "the tracks as labels of the KITTI tracking benchmark", "TRACKS.txt");
  line.addFile("--mot", arguments.text.mot,
               "the tracks in the format of the MOT Challenge, on the ground plane", "TRACKS.txt");
}

void addMaps(CommandLine& line, Arguments& arguments) {
  CLI::Option* map = line.addFile(
      "--map", arguments.map,
      "a map to localize in, from --save-map or save_map, or a yaml file of map_server", "MAP");
  line.add_option("--start", arguments.start,
                  "approximate start pose in --map, m and degrees; default: unknown")
      ->option_text("X Y HEADING")
      ->expected(3)
      ->needs(map);
  line.addFile("--save-map", arguments.save_map,
               "the final map, with .yaml and .pgm files for map_server next to it", "MAP");
}

void addStages(CommandLine& line, Arguments& arguments) {
  line.addChoice("--until", arguments.last_stage, stageChoices(), untilHelp(), "STAGE");
  line.addChoice(
      "--fusion", arguments.fusion, kFusionLevels,
      "level of fusion: none, low, object or track, as set by the individual options below;\n"
      "recommended: the level recommended by measurements, with road borders",
      "LEVEL");
  for (const NamedSwitch& each : stackSwitches()) {
    line.add_flag(optionOf(each.value), arguments.*each.value, each.help);
  }
  CLI::Option* low_level = line.get_option(optionOf(&StackSwitches::low_level_fusion));
  line.add_option("--grid-rule", arguments.grid_rule,
                  "weighted_sum, priority, maximum, log_odds or dempster_shafer")
      ->option_text("RULE")
      ->needs(low_level);
  line.add_flag("--write-grids", arguments.write_grids,
                "writes /grids/lidar, /grids/stereo, /grids/fused and /grids/conflict")
      ->needs(low_level);
}

}  // namespace

int processorCount() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

std::string optionOf(bool StackSwitches::*value) {
  for (const NamedSwitch& each : stackSwitches()) {
    if (each.value == value) {
      std::string name = each.name;
      std::replace(name.begin(), name.end(), '_', '-');
      return "--" + name;
    }
  }
  return "";
}

bool Arguments::fusesObjects() const { return object_fusion || !fusedSource().empty(); }

std::string Arguments::fusedSource() const {
  return mono ? "--mono" : radar ? "--radar" : cloud_objects ? "--cloud-objects" : "";
}

std::string Arguments::inputTopic(const std::string& topic) const {
  return inputTopic(topic, topic);
}

std::string Arguments::inputTopic(const std::string& topic, const std::string& usual) const {
  const auto remapped = remappings.find(withSlash(topic));
  return remapped == remappings.end() ? withSlash(usual) : remapped->second;
}

Arguments parseArguments(std::vector<std::string> words) {
  Arguments arguments;
  for (const Remapping& one : takeRemappings(words, kInputTopics)) {
    arguments.remappings[withSlash(one.ours)] = one.theirs;
  }
  CommandLine line("run_bag", kDescription, "bags");
  line.footer(kFooter);
  addFiles(line, arguments);
  addMaps(line, arguments);
  addStages(line, arguments);
  line.add_flag("--stereo-from-images", arguments.stereo_from_images,
                "computes the stereo camera's points from its images, as stereo_image_proc does;\n"
                "default: only if the bag has no points");
  line.add_option(
          "--jobs", arguments.jobs,
          "threads; from 2 on, as many match stereo images ahead of the stages, with the same\n"
          "results; default: the number of processors")
      ->option_text("N");
  line.add_flag("--with-truth", arguments.with_truth, "copies /ground_truth/*, too");
  line.add_flag("--quiet", arguments.quiet, "no progress bar and no table");
  line.read(std::move(words));
  switchOn(arguments.fusion, arguments);
  checkArguments(arguments);
  return arguments;
}

}  // namespace datmo
