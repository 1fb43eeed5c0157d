#include "arguments.h"

#include <array>

#include "output_bag.h"

namespace datmo {

namespace {

const std::array<std::string, 14> kInputTopics = {
    "scan",
    "cloud",
    "object_cloud",
    "echoes",
    "odometry",
    "imu",
    "twist",
    "points2",
    "left_image",
    "twist_with_covariance",
    "joint_states",
    "right_image",
    "left_camera_info",
    "right_camera_info",
};

const std::map<std::string, LastStage> kStages = {
    {"grid_fusion", LastStage::kGridFusion},     {"grid_slam", LastStage::kGridSlam},
    {"road_border", LastStage::kRoadBorder},     {"moving_objects", LastStage::kMovingObjects},
    {"object_fusion", LastStage::kObjectFusion}, {"tracker", LastStage::kTracker},
    {"track_fusion", LastStage::kTrackFusion}};

LastStage stageOf(const std::string& name) {
  const auto found = kStages.find(name);
  if (found == kStages.end()) {
    throw UsageError("--until '" + name +
                     "': expected grid_fusion, grid_slam, road_border, moving_objects, "
                     "object_fusion, tracker or track_fusion");
  }
  return found->second;
}

std::string withSlash(const std::string& topic) {
  return topic.empty() || topic.front() == '/' ? topic : "/" + topic;
}

std::string topicNames() {
  std::string names;
  for (const std::string& topic : kInputTopics) {
    names += (names.empty() ? "" : ", ") + topic;
  }
  return names;
}

void addRemapping(const std::string& word, std::size_t separator, Arguments& arguments) {
  const std::string ours = word.substr(0, separator);
  const std::string theirs = word.substr(separator + 2);
  for (const std::string& topic : kInputTopics) {
    if (withSlash(ours) == withSlash(topic) && !theirs.empty()) {
      arguments.remappings[withSlash(ours)] = withSlash(theirs);
      return;
    }
  }
  throw UsageError("'" + word + "': expected one of " + topicNames() + " and := and a topic");
}

void addFile(const std::string& word, Arguments& arguments) {
  if (arguments.input.empty()) {
    arguments.input = word;
  } else if (arguments.output.empty()) {
    arguments.output = word;
  } else {
    throw UsageError("'" + word +
                     "': expected no more than an input and an output bag; 'rosrun datmo_fusion "
                     "merge_bags' makes one bag of a recording's parts");
  }
}

void checkOutputs(const Arguments& arguments) {
  std::vector<std::string> written;
  for (const std::string& file : {arguments.output, arguments.times, arguments.text.tum,
                                  arguments.text.kitti, arguments.text.mot}) {
    if (file.empty()) {
      continue;
    }
    for (const std::string& input : {arguments.input, arguments.config}) {
      if (isSameFile(file, input)) {
        throw UsageError("'" + input + "': the output must not be an input");
      }
    }
    for (const std::string& other : written) {
      if (isSameFile(file, other)) {
        throw UsageError("'" + file + "': expected another file for each output");
      }
    }
    written.push_back(file);
  }
}

void checkFiles(const Arguments& arguments) {
  if (arguments.output.empty()) {
    throw UsageError("expected an input and an output bag");
  }
  checkOutputs(arguments);
  if (arguments.config.empty()) {
    throw UsageError("expected --config and a yaml file");
  }
}

void checkRoadBorder(const Arguments& arguments) {
  if (arguments.last_stage == LastStage::kRoadBorder && !arguments.road_border) {
    throw UsageError("--until road_border: expected --road-border with it");
  }
  if (arguments.last_stage < LastStage::kRoadBorder && arguments.road_border) {
    throw UsageError("--road-border: expected no --until before road_border");
  }
}

void checkTrackFusion(const Arguments& arguments) {
  if (arguments.last_stage == LastStage::kTrackFusion && !arguments.track_fusion) {
    throw UsageError("--until track_fusion: expected --track-fusion with it");
  }
  if (arguments.last_stage < LastStage::kTracker && arguments.track_fusion) {
    throw UsageError("--track-fusion: expected no --until but tracker or track_fusion");
  }
}

void checkFusion(const Arguments& arguments) {
  const bool low_level = arguments.write_grids || !arguments.grid_rule.empty() ||
                         arguments.last_stage == LastStage::kGridFusion;
  if (low_level && !arguments.low_level_fusion) {
    throw UsageError(
        "--write-grids, --grid-rule and --until grid_fusion: expected --low-level-fusion with "
        "them");
  }
  if (arguments.last_stage == LastStage::kObjectFusion && !arguments.object_fusion) {
    throw UsageError("--until object_fusion: expected --object-fusion with it");
  }
  if (arguments.last_stage < LastStage::kObjectFusion && arguments.object_fusion) {
    throw UsageError(
        "--object-fusion: expected no --until but object_fusion, tracker or track_fusion");
  }
  checkTrackFusion(arguments);
  if (arguments.stereo_from_images && !arguments.low_level_fusion && !arguments.object_fusion &&
      !arguments.track_fusion) {
    throw UsageError(
        "--stereo-from-images: expected --low-level-fusion, --object-fusion or --track-fusion "
        "with it");
  }
}

/// Whether it is one of the options without a value, which is set then.
bool setSwitch(const std::string& word, Arguments& arguments) {
  const std::map<std::string, bool*> switches = {
      {"--with-truth", &arguments.with_truth},
      {"--quiet", &arguments.quiet},
      {"--low-level-fusion", &arguments.low_level_fusion},
      {"--road-border", &arguments.road_border},
      {"--static-points", &arguments.static_points},
      {"--cloud-objects", &arguments.cloud_objects},
      {"--object-fusion", &arguments.object_fusion},
      {"--track-fusion", &arguments.track_fusion},
      {"--stereo-from-images", &arguments.stereo_from_images},
      {"--write-grids", &arguments.write_grids},
  };
  const auto found = switches.find(word);
  if (found != switches.end()) {
    *found->second = true;
  }
  return found != switches.end();
}

bool setTextFile(const std::string& word, const std::string& value, TextFiles& files) {
  const std::map<std::string, std::string*> options = {
      {"--tum", &files.tum}, {"--kitti", &files.kitti}, {"--mot", &files.mot}};
  const auto found = options.find(word);
  if (found != options.end()) {
    *found->second = value;
  }
  return found != options.end();
}

/// The same for those with a value.
bool setValue(const std::string& word, const std::string& value, Arguments& arguments) {
  if (word == "--config") {
    arguments.config = value;
  } else if (word == "--until") {
    arguments.last_stage = stageOf(value);
  } else if (word == "--times") {
    arguments.times = value;
  } else if (word == "--grid-rule") {
    arguments.grid_rule = value;
  } else {
    return setTextFile(word, value, arguments.text);
  }
  return true;
}

}  // namespace

std::string stageType(LastStage stage) {
  for (const auto& [type, each] : kStages) {
    if (each == stage) {
      return type;
    }
  }
  return "";
}

std::string Arguments::inputTopic(const std::string& topic) const {
  return inputTopic(topic, topic);
}

std::string Arguments::inputTopic(const std::string& topic, const std::string& usual) const {
  const auto remapped = remappings.find(withSlash(topic));
  return remapped == remappings.end() ? withSlash(usual) : remapped->second;
}

std::string usage() {
  return "usage: run_bag IN.bag OUT.bag --config CONFIG.yaml [--with-truth] [--quiet]"
         " [--until STAGE]\n"
         "               [--low-level-fusion [--grid-rule RULE] [--write-grids]]"
         " [--road-border]\n"
         "               [--object-fusion] [--track-fusion] [--stereo-from-images] [--times "
         "FILE.json]\n"
         "               [--tum POSES.txt] [--kitti TRACKS.txt] [--mot TRACKS.txt]\n"
         "               [TOPIC:=TOPIC_OF_THE_BAG ...]\n"
         "Takes the scans and the odometry of a bag through the stack, as fast as it goes, and "
         "writes\n"
         "/pose, /map, /labeled_scan, /objects, /tracks and /tf to another bag.\n"
         "  --config CONFIG.yaml  the sensor set, e.g. config/demonstrator.yaml\n"
         "  --with-truth          copies /ground_truth/* along\n"
         "  --quiet               no progress bar and no table\n"
         "  --until STAGE         goes no further than grid_fusion, grid_slam, road_border,\n"
         "                        moving_objects, object_fusion, tracker or track_fusion\n"
         "  --low-level-fusion    fuses the grids of scanner and stereo camera before grid_slam\n"
         "  --road-border         finds the borders of the road and leaves out false objects on "
         "and beyond\n"
         "                        them, and writes /road_borders and /objects/dropped\n"
         "  --cloud-objects       finds objects in a 3D lidar's clouds, and writes /objects/cloud\n"
         "  --static-points       writes what stands still: /static_points and /static_scan\n"
         "  --object-fusion       fuses the objects of scanner and stereo camera before tracker, "
         "and\n"
         "                        writes /objects/stereo and /objects/fused\n"
         "  --track-fusion        follows the stereo camera's objects too and fuses the tracks, "
         "and\n"
         "                        writes /tracks/lidar, /tracks/stereo and /objects/stereo\n"
         "  --stereo-from-images  computes the stereo camera's points from its images, as\n"
         "                        stereo_image_proc does; without it only where the bag has no "
         "points\n"
         "  --grid-rule RULE      weighted_sum, priority, maximum, log_odds or dempster_shafer\n"
         "  --write-grids         writes /grids/lidar, /grids/stereo, /grids/fused, "
         "/grids/conflict\n"
         "  --times FILE.json     how long each stage took for a message\n"
         "  --tum POSES.txt       the vehicle's poses as the TUM benchmark has them, base_link in "
         "map\n"
         "  --kitti TRACKS.txt    the tracks as labels of KITTI's tracking benchmark\n"
         "  --mot TRACKS.txt      the tracks as MOT Challenge has them, on the ground plane\n"
         "  TOPIC:=...            scan, cloud (a 3D lidar's, in place of scans), object_cloud\n"
         "                        (one for --cloud-objects beside scans), echoes,\n"
         "                        odometry, imu, twist, twist_with_covariance,\n"
         "                        joint_states, points2, left_image, right_image, "
         "left_camera_info\n"
         "                        or right_camera_info under another name\n"
         "Exit code: 0 when done; 1 for a command line, yaml file or bag that is wrong or lacks a\n"
         "topic, and when interrupted; 2 when all messages on a topic were refused, no scan could "
         "be\n"
         "used or no tracks came out. After 1 and 2 no output bag is left.\n";
}

Arguments parseArguments(const std::vector<std::string>& words) {
  Arguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const std::size_t separator = word.find(":=");
    if (setSwitch(word, arguments)) {
      continue;
    }
    if (i + 1 < words.size() && setValue(word, words[i + 1], arguments)) {
      ++i;
    } else if (separator != std::string::npos) {
      addRemapping(word, separator, arguments);
    } else if (word.empty() || word.front() == '-') {
      throw UsageError("'" + word + "': no such option, or its value is missing");
    } else {
      addFile(word, arguments);
    }
  }
  checkFiles(arguments);
  checkRoadBorder(arguments);
  checkFusion(arguments);
  return arguments;
}

}  // namespace datmo
